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
    return withoutLastZeros(QString::number(sure, 'f', std::max(0, digits - 1 - order)));
}

QString withoutLastZeros(QString number) {
    if (!number.contains(u'.')) return number;
    while (number.endsWith(u'0')) number.chop(1);
    if (number.endsWith(u'.')) number.chop(1);
    return number == QStringLiteral("-0") ? QStringLiteral("0") : number;
}

} // namespace carom
