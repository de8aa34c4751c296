// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/ide.h"
#include "tests/support/test_class.h"

#include <QListWidget>
#include <QSet>

#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

/// Contrast of two colours (W3C, Web Content Accessibility Guidelines 2.1, 1.4.3): 1 to 21.
double contrast(const QColor& a, const QColor& b) {
    const auto luminance = [](const QColor& colour) {
        const auto linear = [](double v) {
            return v <= 0.03928 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
        };
        return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) +
               0.0722 * linear(colour.blueF());
    };
    const double x = luminance(a), y = luminance(b);
    return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

constexpr double readable = 4.5; // the guideline's level AA for text
constexpr double visible = 3.0;  // its level for large text and symbols

} // namespace

class ThemeTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void everyRoleHasAColour_data() {
        QTest::addColumn<bool>("dark");
        QTest::newRow("dark") << true;
        QTest::newRow("light") << false;
    }

    void everyRoleHasAColour() {
        QFETCH(bool, dark);
        const Theme theme = loadTheme(dark);
#define CAROM_ROLE(name) QVERIFY2(theme.name.isValid(), #name);
#include "ui/base/theme_roles.def"
#undef CAROM_ROLE
        QVERIFY(!theme.styleSheet().contains(u'@'));
    }

    void textCanBeReadOnItsBackground_data() { everyRoleHasAColour_data(); }

    void textCanBeReadOnItsBackground() {
        QFETCH(bool, dark);
        const Theme t = loadTheme(dark);
        const auto holds = [](const std::vector<QColor>& inks, const std::vector<QColor>& grounds,
                              double least) {
            for (const QColor& ink : inks)
                for (const QColor& ground : grounds)
                    QVERIFY2(contrast(ink, ground) >= least,
                             qPrintable(ink.name() + QStringLiteral(" on ") + ground.name()));
        };
        const std::vector<QColor> panels = {t.window, t.panel, t.alternate};
        const std::vector<QColor> texts = {t.editor, t.currentLine, t.declarationLine};
        const std::vector<QColor> words = {t.editorText, t.number,  t.declaration, t.parameter,
                                           t.word,       t.comment, t.punctuation, t.brace};
        holds(words, texts, readable);
        holds({t.error, t.warning, t.hint}, texts, readable); // messages stand in the text, too
        holds({t.error, t.warning, t.hint, t.good, t.accent, t.mutedText}, panels, readable);
        holds({t.text}, panels, readable);
        holds({t.text}, {t.button, t.hover, t.selection}, readable);
        holds({t.accentText}, {t.accent, t.error}, readable);
        holds({t.lineNumber, t.fold}, {t.editor, t.currentLine}, visible);
        holds({t.disabledText}, panels, visible);
    }

    void aChosenRowHasItsTextWhereTheOthersHaveIt() {
        QListWidget list;
        list.setPalette(loadTheme(true).palette());
        list.setStyleSheet(loadTheme(true).styleSheet());
        list.addItems({QStringLiteral("one"), QStringLiteral("two")});
        list.show();
        QVERIFY(QTest::qWaitForWindowExposed(&list, longestWait));
        const auto firstInk = [&list](int row) { // column of pixels
            const QImage picture = list.viewport()->grab(list.visualItemRect(list.item(row))).toImage();
            const QColor ground = picture.pixelColor(2, picture.height() / 2);
            for (int x = 3; x < picture.width(); ++x)
                for (int y = 3; y < picture.height() - 3; ++y)
                    if (contrast(picture.pixelColor(x, y), ground) > visible) return x;
            return -1;
        };
        list.clearSelection();
        list.setCurrentItem(nullptr);
        const int usual = firstInk(0);
        list.item(0)->setSelected(true);
        QVERIFY(usual > 0);
        QCOMPARE(firstInk(0), usual);
    }

    void everyIconOfTheActionsExists() {
        const Theme theme = loadTheme(true);
        for (const ActionRow& row : actionRows()) {
            if (row.icon == nullptr || *row.icon == '\0') continue;
            QVERIFY2(!theme.icon(QString::fromLatin1(row.icon)).isNull(), row.icon);
        }
    }

    void noTwoActionsShareAShortcut() {
        QObject owner;
        const Actions actions(&owner);
        QSet<QString> seen;
        for (const QKeySequence& key : actions.shortcuts()) {
            QVERIFY2(!key.isEmpty(), "a shortcut that is none");
            QVERIFY2(!seen.contains(key.toString()), qPrintable(key.toString()));
            seen.insert(key.toString());
        }
    }

    void everyActionSaysWhatItDoes() {
        for (const ActionRow& row : actionRows())
            if (row.text != nullptr) QVERIFY2(QByteArray(row.tip).size() > 10, row.text);
    }
};

CAROM_TEST_WITH(IdeApplication, theme_test, ThemeTest)
#include "theme_test.moc"
