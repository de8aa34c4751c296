// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/numbers.h"

#include <QLocale>

#include <clocale>

namespace carom {

void writeNumbersAsScenesDo() {
    QLocale::setDefault(QLocale::c());
    std::setlocale(LC_NUMERIC, "C");
}

} // namespace carom
