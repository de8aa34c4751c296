// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/numbers.h"

#include <QLocale>

#include <algorithm>
#include <clocale>
#include <cmath>

namespace carom {

void writeNumbersAsScenesDo() {
    QLocale::setDefault(QLocale::c());
    std::setlocale(LC_NUMERIC, "C");
}

QString rounded(double value, int digits) {
    // Rounded first: 9.99 to two digits is 10, which has no decimal.
    const double sure = QString::number(value, 'e', digits - 1).toDouble();
    const int order = sure == 0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(sure))));
    QString text = QString::number(sure, 'f', std::max(0, digits - 1 - order));
    if (!text.contains(u'.')) return text;
    while (text.endsWith(u'0')) text.chop(1);
    if (text.endsWith(u'.')) text.chop(1);
    return text;
}

} // namespace carom
