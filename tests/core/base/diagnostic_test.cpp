// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/base/diagnostic_list.h"

#include <QObject>
#include <QTest>

#include <set>
#include <string>
#include <string_view>

namespace {

using carom::Diagnostic;
using carom::DiagnosticCode;
using carom::DiagnosticList;

class DiagnosticTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void codesAreUniqueAndWrittenAlike() {
        std::set<std::string_view> seen;
        for (const carom::DiagnosticCodeRow& row : carom::diagnosticCodes()) {
            QVERIFY2(seen.insert(row.code).second, row.code.data());
            QVERIFY2(row.code.starts_with("sdl-"), row.code.data());
            QVERIFY2(row.code.find_first_not_of("abcdefghijklmnopqrstuvwxyz-") == std::string_view::npos,
                     row.code.data());
            QVERIFY2(row.help.ends_with('.'), row.code.data());
        }
    }

    void aCodeFindsItsRow() {
        QCOMPARE(rowOf(DiagnosticCode::UnknownParameter).code, std::string_view("sdl-unknown-parameter"));
        QCOMPARE(nameOf(rowOf(DiagnosticCode::Tunnelling).severity), std::string_view("warning"));
    }

    void onlyErrorsAreErrors() {
        std::vector<Diagnostic> list(1);
        list[0].code = DiagnosticCode::Tunnelling;
        QVERIFY(!hasErrors(list));
        list.emplace_back().code = DiagnosticCode::StrayBrace;
        QVERIFY(hasErrors(list));
    }

    void aListKeepsTheFirstThousandAndCountsAll() {
        DiagnosticList list;
        for (std::uint32_t i = 0; i < 2500; ++i) {
            Diagnostic* entry = list.report(DiagnosticCode::StrayBrace, {i, 1});
            QCOMPARE(entry != nullptr, i < DiagnosticList::capacity);
        }
        QCOMPARE(list.total(), std::uint64_t{2500});
        QCOMPARE(list.take().back().range.offset, 999U);
    }
};

} // namespace

CAROM_TEST(diagnostic_test, DiagnosticTest)
#include "diagnostic_test.moc"
