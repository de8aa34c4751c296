// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/plain_words.h"

#include <QTextDocument>

namespace carom {

QString plainTip(const QString& text) {
    return Qt::mightBeRichText(text) ? Qt::convertFromPlainText(text, Qt::WhiteSpaceNormal) : text;
}

QString plainTitle(const QString& text) {
    return QString(text).replace(QLatin1Char('&'), QLatin1StringView("&&"));
}

} // namespace carom
