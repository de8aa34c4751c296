// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "ui/editor/text_search.h"

#include <QTest>

#include <string>

using namespace carom;

namespace {

std::vector<SourceRange> allOf(const QByteArray& text, const SearchQuery& query) {
    return TextSearch(query).all(text, [] { return true; });
}

QByteArray partOf(const QByteArray& text, std::optional<SourceRange> range) {
    return range ? text.mid(range->offset, range->length) : QByteArray("<none>");
}

} // namespace

class TextSearchTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void matchesAreFoundForwardsAndBackwards() {
        const QByteArray text = "one two\r\nTWO three\ntwo";
        const TextSearch search({QStringLiteral("two"), false, false});
        QCOMPARE(allOf(text, {QStringLiteral("two"), false, false}).size(), std::size_t{3});
        QCOMPARE(allOf(text, {QStringLiteral("two"), false, true}).size(), std::size_t{2});
        QCOMPARE(search.next(text, 0)->offset, 4U);
        QCOMPARE(search.next(text, 5)->offset, 9U);
        QCOMPARE(search.previous(text, text.size())->offset, 19U);
        QCOMPARE(search.previous(text, 19)->offset, 9U);
        QVERIFY(!search.previous(text, 4));
        QVERIFY(search.isMatch(text, {4, 3}));
        QVERIFY(!search.isMatch(text, {4, 2}));
    }

    void placesAreBytesWhateverTheLettersAre() {
        const QByteArray text = "// größer\nGRÖSSE \xFF gr\xC3\xB6"
                                "\n";
        const TextSearch search({QStringLiteral("öß"), false, true});
        QCOMPARE(partOf(text, search.next(text, 0)), QByteArray("öß"));
        // A line that is no UTF-8 is searched by its bytes.
        QCOMPARE(allOf(text, {QStringLiteral("GR"), false, true}).size(), std::size_t{1});
        QCOMPARE(allOf(text, {QStringLiteral("^\\W*gr."), true, true}).front().offset, 0U);
    }

    void emptyMatchesAndBrokenExpressionsEnd() {
        QCOMPARE(allOf("a\nb\n", {QStringLiteral("x*"), true, false}).size(), std::size_t{5});
        QVERIFY(allOf("a\nb\n", {QStringLiteral("("), true, false}).empty());
        QVERIFY(!TextSearch({QStringLiteral("("), true, false}).problem().isEmpty());
        QVERIFY(TextSearch({QStringLiteral("("), false, false}).problem().isEmpty());
        QVERIFY(allOf("a", {QString(), true, false}).empty());
    }

    // The C++ library's expressions call themselves once a letter: 60,000 of them ended the program.
    void noExpressionTakesMoreThanAMomentOrTheStack() {
        const QByteArray line(60'000, 'a');
        for (const char* pattern :
             {"(a|b)*c", ".*c", "(a|b)*[cd]", "(a+)+[bc]", "(?:a|a)*[bc]", "((a*)*)*[bc]"}) {
            const SearchQuery query{QString::fromLatin1(pattern), true, true};
            QVERIFY2(allOf(line + "\n" + line, query).empty(), pattern);
        }
        QCOMPARE(allOf(line, {QStringLiteral("a*"), true, true}).front().length, 60'000U);
    }

    void replacementsNameGroups() {
        const QByteArray text = "vel 1, 2\n";
        const TextSearch search({QStringLiteral("(\\d), (\\d)"), true, true});
        QCOMPARE(search.replacementOf(text, {4, 4}, QStringLiteral("\\2, \\1 [\\0] \\\\ \\9 ö𝄞")),
                 QByteArray("2, 1 [1, 2] \\  ö𝄞"));
        const TextSearch plain({QStringLiteral("vel"), false, true});
        QCOMPARE(plain.replacementOf(text, {0, 3}, QStringLiteral("\\1")), QByteArray("\\1"));
    }
};

CAROM_TEST(text_search_test, TextSearchTest)
#include "text_search_test.moc"
