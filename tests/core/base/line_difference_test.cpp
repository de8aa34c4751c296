// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/base/line_difference.h"

#include <QObject>
#include <QTest>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace {

using carom::DifferenceLine;
using carom::LineChange;
using carom::lineDifference;

constexpr std::uint32_t seed = 7;

/// "-removed +added  kept", one line behind the other.
std::string shown(std::string_view before, std::string_view after) {
    std::string text;
    for (const DifferenceLine& line : lineDifference(before, after)) {
        text += line.change == LineChange::Kept ? ' ' : line.change == LineChange::Added ? '+' : '-';
        text += line.text;
    }
    return text;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

std::string side(const std::vector<DifferenceLine>& difference, LineChange other) {
    std::string text;
    for (const DifferenceLine& line : difference)
        if (line.change != other) text += std::string(line.text) + "\n";
    return text;
}

/// The length of the longest common subsequence, by the table.
std::size_t commonLines(const std::vector<std::string>& a, const std::vector<std::string>& b) {
    std::vector<std::size_t> row(b.size() + 1, 0);
    for (const std::string& line : a) {
        std::size_t diagonal = 0;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t above = row[j + 1];
            row[j + 1] = line == b[j] ? diagonal + 1 : std::max(row[j], above);
            diagonal = above;
        }
    }
    return row.back();
}

} // namespace

class LineDifferenceTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void changesAreShownWhereTheyAre() {
        QCOMPARE(shown("a\nb\nc\n", "a\nB\nc\n"), std::string(" a-b+B c"));
        QCOMPARE(shown("", "a\n"), std::string("+a"));
        QCOMPARE(shown("a\n", ""), std::string("-a"));
        QCOMPARE(shown("", ""), std::string());
        QCOMPARE(shown("a\nb\n", "a\nb\nc"), std::string(" a b+c"));
        QCOMPARE(shown("a\r\nb\r\n", "a\nb\n"), std::string(" a b"));
    }

    void bothTextsCanBeReadBackAndNoLineChangesWithoutNeed() {
        std::mt19937 random(seed);
        for (int turn = 0; turn < 400; ++turn) {
            std::uniform_int_distribution<int> size(0, 24), letter(0, 3);
            std::vector<std::string> a(static_cast<std::size_t>(size(random))),
                b(static_cast<std::size_t>(size(random)));
            for (std::vector<std::string>* lines : {&a, &b})
                for (std::string& line : *lines)
                    line = std::string(1, static_cast<char>('a' + letter(random)));
            const std::string before = joined(a), after = joined(b);
            const std::vector<DifferenceLine> difference = lineDifference(before, after);
            QCOMPARE(side(difference, LineChange::Added), before);
            QCOMPARE(side(difference, LineChange::Removed), after);
            const auto kept = static_cast<std::size_t>(
                std::count_if(difference.begin(), difference.end(),
                              [](const auto& l) { return l.change == LineChange::Kept; }));
            QCOMPARE(kept, commonLines(a, b));
        }
    }

    void textsThatShareNothingAreReplacedAsAWhole() {
        std::vector<std::string> a, b;
        for (int i = 0; i < 5000; ++i) {
            a.push_back("old " + std::to_string(i));
            b.push_back("new " + std::to_string(i));
        }
        a.front() = b.front() = "the same";
        const std::string before = joined(a), after = joined(b);
        const std::vector<DifferenceLine> difference = lineDifference(before, after);
        QCOMPARE(side(difference, LineChange::Added), before);
        QCOMPARE(side(difference, LineChange::Removed), after);
        QCOMPARE(difference.front().change, LineChange::Kept);
        QCOMPARE(difference[1].change, LineChange::Removed);
    }
};

CAROM_TEST(line_difference_test, LineDifferenceTest)
#include "line_difference_test.moc"
