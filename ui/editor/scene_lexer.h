// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/editor/scintilla.h"

namespace carom {

struct Theme;

/// Colours a scene's text with core's own lexer: an adapter, not a second lexer. Which names are
/// declarations, parameters or words is asked of the schema. Tokens never cross a line, so any run of whole
/// lines can be coloured by itself; brace depth is kept a line at a time and makes the folds.
class SceneLexer : public QsciLexerCustom {
    Q_OBJECT
  public:
    enum Style { Plain, Comment, Number, Declaration, Parameter, Word, Punctuation, Unknown, StyleCount };

    SceneLexer(const Theme& theme, const QFont& font, QObject* parent);

    void setTextFont(const QFont& font);
    void setTheme(const Theme& theme);

    const char* language() const override { return "SDL"; }
    QString description(int style) const override;
    void styleText(int start, int end) override;
    const char* blockStart(int* style) const override;
    const char* blockEnd(int* style) const override;
    int braceStyle() const override { return Punctuation; }
    const char* wordCharacters() const override;

  private:
    void fold(int firstLine, int lastLine, const std::vector<int>& depthAtLineEnd);
};

} // namespace carom
