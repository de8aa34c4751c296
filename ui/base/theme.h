// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QIcon>
#include <QPalette>
#include <QString>

class QApplication;

// The look of everything, from one palette: resources/themes/palette.json gives every role its colour in the
// dark and in the light theme; widgets, editor, icons and panels take their colours from here and nowhere
// else.

namespace carom {

struct Theme {
    bool dark = true;
#define CAROM_ROLE(name) QColor name;
#include "ui/base/theme_roles.def"
#undef CAROM_ROLE

    QPalette palette() const;
    /// Spacing and borders that Fusion alone does not give.
    QString styleSheet() const;
    /// `:/icons/NAME.svg` drawn in the text's colour, where the file says `currentColor`; a null icon if
    /// there is no such file.
    QIcon icon(const QString& name) const;
    QIcon icon(const QString& name, const QColor& colour) const;
};

Theme loadTheme(bool dark);
/// Style, palette and style sheet of the whole application.
void applyTheme(QApplication& application, const Theme& theme);

} // namespace carom
