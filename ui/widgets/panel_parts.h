// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

class QLayout;
class QToolButton;
class QWidget;

// What several panels are put together from.

namespace carom {

/// A button that says what it does; `name` is for tests and styles.
QToolButton* wordButton(const char* name, const QString& words, const QString& tip);

/// A panel's content: controls in a column `width` pixels wide, and beside it what they are about.
QWidget* besideControls(QLayout* controls, int width, QWidget* content);

} // namespace carom
