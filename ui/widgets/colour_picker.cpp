// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/colour_picker.h"

#include <QColorDialog>
#include <QCoreApplication>

#include <cmath>
#include <utility>

namespace carom {
namespace {

struct ColourPickerTexts {
    Q_DECLARE_TR_FUNCTIONS(ColourPicker)
};

} // namespace

QString colourText(const QColor& colour) {
    const auto part = [](double value) { return QString::number(std::round(1000 * value) / 1000); };
    return QStringLiteral("%1, %2, %3").arg(part(colour.redF()), part(colour.greenF()), part(colour.blueF()));
}

void pickColour(QWidget* parent, const QColor& current, std::function<void(const QString& text)> take) {
    QColorDialog* dialog = new QColorDialog(current, parent);
    dialog->setWindowTitle(ColourPickerTexts::tr("Choose a colour"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    QObject::connect(dialog, &QColorDialog::colorSelected, parent,
                     [take = std::move(take)](const QColor& chosen) { take(colourText(chosen)); });
    dialog->open();
}

} // namespace carom
