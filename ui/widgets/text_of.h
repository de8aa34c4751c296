// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/sentence.h"

#include <QCoreApplication>
#include <QString>

#include <cstddef>
#include <string>
#include <string_view>

namespace carom {

/// What core says, for a widget.
inline QString textOf(std::string_view utf8) {
    return QString::fromUtf8(utf8.data(), static_cast<qsizetype>(utf8.size()));
}

/// A sentence of core in the language of the window; names and figures stay as they are.
inline QString sentence(const Sentence& said) {
    QString words = QCoreApplication::translate("carom::Core", std::string(said.pattern).c_str());
    QString filled;
    for (qsizetype i = 0; i < words.size(); ++i) {
        const std::size_t place = words[i] == u'%' && i + 1 < words.size()
                                      ? static_cast<std::size_t>(words[i + 1].digitValue() - 1)
                                      : said.values.size();
        if (place >= said.values.size())
            filled += words[i];
        else
            filled += QString::fromStdString(said.values[place]), ++i;
    }
    return filled;
}

inline QString sentences(const Reason& reason) {
    QString words;
    for (const Reason::Part& part : reason.parts())
        words += (words.isEmpty() ? QString() : textOf(part.joint)) + sentence(part.sentence);
    return words;
}

} // namespace carom
