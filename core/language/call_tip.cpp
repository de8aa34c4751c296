// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/call_tip.h"

#include "core/language/description.h"
#include "core/language/open_list.h"
#include "core/scene/schema.h"

#include <algorithm>
#include <string_view>

namespace carom {
namespace {

/// Where the signature names the parameter: a word of its own, perhaps in brackets.
SourceRange placeIn(std::string_view signature, std::string_view parameter) {
    const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
    const std::size_t open = signature.find('{');
    for (std::size_t at = signature.find(parameter, open); at != signature.npos;
         at = signature.find(parameter, at + 1)) {
        const std::size_t end = at + parameter.size();
        if (!isLetter(signature[at - 1]) && !isLetter(signature[end]))
            return {static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(parameter.size())};
    }
    return {};
}

} // namespace

std::optional<CallTip> callTipAt(const Analysis& analysis, std::uint32_t offset) {
    const std::vector<Token>& tokens = analysis.tokens;
    const auto behind =
        std::lower_bound(tokens.begin(), tokens.end(), offset,
                         [](const Token& token, std::uint32_t place) { return token.range.offset < place; });
    const std::size_t place = static_cast<std::size_t>(behind - tokens.begin());
    const std::optional<OpenList> list = openListAt(analysis, place);
    if (!list) return std::nullopt;

    CallTip tip{list->type, signatureOf(*list->row), {}, {}, std::string(list->row->help)};
    const ParameterRow* current = nullptr;
    for (std::size_t i = list->brace + 1; i < place; ++i)
        if (tokens[i].kind == TokenKind::Name)
            if (const ParameterRow* row = list->row->find(textOf(analysis.text, tokens[i].range)))
                current = row;
    if (current != nullptr) {
        tip.current = placeIn(tip.signature, current->name);
        tip.summary = summaryOf(*current);
        tip.help = current->help;
    }
    return tip;
}

} // namespace carom
