// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/base/csv.h"

#include <QObject>
#include <QTest>

#include <limits>
#include <string>
#include <vector>

namespace {

using carom::csvSplit;
using carom::CsvTable;
using carom::csvValue;

class CsvTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aRowHasItsCellsInOrderAndNumbersInFull() {
        CsvTable table("name,n,time_s");
        table.row("grid", 3, 0.1);
        table.row(std::string("tree"), std::uint64_t(1) << 63, 1e-300);
        QCOMPARE(table.take(), std::string("name,n,time_s\ngrid,3,0.1\ntree,9223372036854775808,1e-300\n"));
    }

    void whatIsNotANumberIsAnEmptyCell() {
        CsvTable table("a,b");
        table.row(std::numeric_limits<double>::quiet_NaN(), "");
        QCOMPARE(table.take(), std::string("a,b\n,\n"));
    }

    void textWithCommasQuotesAndLinesComesBackAsItWas() {
        const std::vector<std::string> values = {"plain", "a,b", "say \"so\"", "two\nlines", "", "\"", "\","};
        CsvTable table("a,b,c,d,e,f,g");
        table.row(values[0], values[1], values[2], values[3], values[4], values[5], values[6]);
        const std::string text = table.take();
        const std::vector<std::string_view> lines = csvSplit(text, '\n');
        QCOMPARE(lines.size(), std::size_t(3)); // the last is empty
        const std::vector<std::string_view> fields = csvSplit(lines[1], ',');
        QCOMPARE(fields.size(), values.size());
        for (std::size_t k = 0; k < values.size(); ++k) QCOMPARE(csvValue(fields[k]), values[k]);
    }
};

} // namespace

CAROM_TEST(csv_test, CsvTest)
#include "csv_test.moc"
