// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QString>

#include <functional>

class QWidget;

namespace carom {

/// As the scene language writes it: red, green and blue from 0 to 1, with three decimals at most.
QString colourText(const QColor& colour);

/// Asks for another colour, and gives it to `take` as text once one was chosen. Does not wait.
void pickColour(QWidget* parent, const QColor& current, std::function<void(const QString& text)> take);

} // namespace carom
