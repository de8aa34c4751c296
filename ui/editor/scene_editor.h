// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/editor/scintilla.h"
#include "ui/base/document.h"

#include "core/base/source.h"

#include <cstdint>

class QMenu;

namespace carom {

struct Theme;
class SceneLexer;

/// Margins of the editor, from the left. Inside QsciScintilla the first two names are its kinds of margins,
/// with the same values.
enum EditorMargin { SymbolMargin, NumberMargin, FoldMargin };

/// Markers: Scintilla draws higher numbers over lower ones.
enum EditorMarker {
    DeclarationMarker = 1,
    WaitingCheckMarker,
    HeldCheckMarker,
    FailedCheckMarker,
    HintMarker,
    WarningMarker,
    ErrorMarker
};

/// The text of a scene. Its bytes are UTF-8 and its positions are byte offsets, so the ranges of core's
/// tokens, declarations and diagnostics fit without conversion.
class SceneEditor : public QsciScintilla, public TextBuffer {
    Q_OBJECT
  public:
    SceneEditor(const Theme& theme, QWidget* parent = nullptr);

    void setTheme(const Theme& theme);
    /// Gives up Scintilla's own use of these keys, so that the window's actions get them.
    void releaseKeys(const QList<QKeySequence>& keys);

    std::uint32_t caret() const;
    /// Lines that are too long for the width go on below; the text stays as it is.
    void setWrapsLines(bool wraps);
    /// Puts the caret at the range's beginning, selects it, unfolds and scrolls to it; with the beginning of
    /// its line, where both are in view.
    void reveal(SourceRange range);
    /// Puts the caret at a place, as far as there is one, and a line at the top.
    void goTo(std::int64_t offset, std::int64_t firstLine);
    /// The font of text and margins; an empty family is the system's fixed one.
    void setTextFont(const QString& family, int points);
    /// Tints the lines of a declaration; an empty range clears.
    void markDeclaration(SourceRange range);
    void toggleComment();
    /// The word at the caret; with a selection, where its text stands next as well.
    void selectNextOccurrence();
    /// One undo step. Nothing goes before a byte order mark.
    void replaceRange(SourceRange range, const QByteArray& text);
    /// Another text in the place of all: one undo step of what differs; caret, folds and marks elsewhere
    /// stay.
    void changeBytes(const QByteArray& bytes);
    /// A text of our own making, with its line ends as the scene has them.
    QByteArray withLineEnds(QByteArray text) const;
    /// What stands there; less where the text ends before.
    QByteArray bytesOf(SourceRange range) const;

    QByteArray bytes() const override;
    void setBytes(const QByteArray& bytes) override;
    bool differsFromSaved() const override { return m_neverSaved || isModified(); }
    void markSaved() override;
    void markUnsaved() override;
    void exchangeBytes(const QByteArray& bytes) override;

    /// A tip at a place of the viewport [px]; none over a menu that is open, which it would cover.
    void showTip(const QPoint& place, const QString& html);

    long send(unsigned int message, std::int64_t a = 0, std::int64_t b = 0) const;

  Q_SIGNALS:
    void caretMoved(std::uint32_t offset);
    void savedStateChanged(bool differs);
    void fileDropped(const QString& path);
    /// Another text is about to take the place of this one, with its undo steps: one that is open ends now.
    void aboutToBeReplaced();
    /// The menu of a right click, or of the menu key, is about to open at a place of the text: who has
    /// something to offer adds it.
    void menuOpens(QMenu& menu, std::uint32_t offset);

  protected:
    void contextMenuEvent(QContextMenuEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dragMoveEvent(QDragMoveEvent* event) override;
    void dropEvent(QDropEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

  private:
    void configureEditing();
    void configureMargins();
    void fitNumberMargin();

    SceneLexer* m_lexer;
    bool m_neverSaved = false;
};

} // namespace carom
