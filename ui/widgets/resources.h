// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

class QString;
class QByteArray;

namespace carom {

/// A file of resources/carom.qrc, e.g. "shaders/sphere.vert", or of the gallery, "scenes/pile.sdl". A name
/// that is not there is a programmer's mistake.
QByteArray resource(const QString& name);

} // namespace carom
