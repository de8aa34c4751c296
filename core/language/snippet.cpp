// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/snippet.h"

#include "core/language/analysis.h"
#include "core/language/description.h"

namespace carom {

Snippet snippetFor(const DeclarationRow& row) {
    Snippet snippet{snippetOf(row), {}};
    for (const ParameterSyntax& parameter : analyse(snippet.text).tree.parameters)
        snippet.fields.push_back(parameter.value);
    return snippet;
}

} // namespace carom
