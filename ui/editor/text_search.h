// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/editor/scene_editor.h"

#include "core/base/source.h"

#include <QString>

#include <optional>

namespace carom {

struct SearchQuery {
    QString text;
    bool regularExpression = false; ///< ECMAScript's
    bool matchCase = false;
};

/// The first match that begins in [from, to), or the last one where `to` < `from`. Nothing, too, where the
/// regular expression is not one.
std::optional<SourceRange> findMatch(const SceneEditor& editor, const SearchQuery& query, std::int64_t from,
                                     std::int64_t to);
/// Matches in the whole text.
int countMatches(const SceneEditor& editor, const SearchQuery& query);

/// Replaces the match at the range; `\1` stands for a group of a regular expression. Returns the bytes
/// behind.
std::int64_t replaceMatch(SceneEditor& editor, const SearchQuery& query, SourceRange match,
                          const QString& replacement);
/// One undo step; how many were replaced.
int replaceAllMatches(SceneEditor& editor, const SearchQuery& query, const QString& replacement);

} // namespace carom
