// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/language/formatter.h"
#include "core/scene/schema.h"

#include <QObject>
#include <QTest>

#include <string>
#include <string_view>
#include <vector>

// The canonical layout by golden cases. That nothing but white space ever changes, on any bytes, is held by
// tests/fuzz.

namespace {

struct Layout {
    const char* name;
    std::string source;
    std::string formatted;
};

const std::vector<Layout>& layouts() {
    static const std::vector<Layout> rows = {
        {"an empty text stays empty", "", ""},
        {"white space alone vanishes", " \n\t\r\n\f", ""},
        {"a declaration gets its line", "wall{normal 0,1,0toOrig 0}", "wall { normal 0, 1, 0  toOrig 0 }\n"},
        {"two declarations get two lines", "gravity ; camera;", "gravity;\ncamera;\n"},
        {"an empty list closes at once", "gravity\n{\n\n}", "gravity {}\n"},
        {"a label stands between type and brace", "wall\tfloor{toOrig 0}", "wall floor { toOrig 0 }\n"},
        {"signs stick to their numbers and colons to their names", "wall { toOrig :- - 1 normal:0 ,- 1 , 0 }",
         "wall { toOrig: --1  normal: 0, -1, 0 }\n"},
        {"a first parameter below the brace asks for lines", "wall {\nnormal 0, 1, 0 toOrig 0 }",
         "wall {\n    normal 0, 1, 0\n    toOrig 0\n}\n"},
        {"a break elsewhere does not", "wall { normal 0, 1, 0\n\n  toOrig 0\n}",
         "wall { normal 0, 1, 0  toOrig 0 }\n"},
        {"what is longer than 100 columns is broken into lines",
         "sphere { radius 1 mass 1 centre 1.23456789, 2.3456789, 3.456789 vel 1.23456789, 2.3456789, "
         "3.456789 "
         "elastic 1 }",
         "sphere {\n    radius 1\n    mass 1\n    centre 1.23456789, 2.3456789, 3.456789\n"
         "    vel 1.23456789, 2.3456789, 3.456789\n    elastic 1\n}\n"},
        {"comments stay where they are",
         "  # head  \n\n\n\nwall{ // one\n# two\nnormal 0,1,0 // three\n\n\n//four\ntoOrig 0//five\n} // "
         "six\n//end",
         "# head\n\nwall {  // one\n    # two\n    normal 0, 1, 0  // three\n\n    //four\n    toOrig 0  "
         "//five\n}  // "
         "six\n//end\n"},
        {"a comment inside a value keeps the rest of it indented", "wall { normal 0, // x\n1,0 toOrig 0 }",
         "wall {\n    normal 0,  // x\n        1, 0\n    toOrig 0\n}\n"},
        {"a comment before the brace keeps the brace below", "wall // big\n{ toOrig 0 }",
         "wall  // big\n{\n    toOrig 0\n}\n"},
        {"an empty line between two parameters stays, a second does not",
         "wall {\n\n\n  normal 0, 1, 0\n\n\n\n  toOrig 0\n\n}",
         "wall {\n    normal 0, 1, 0\n\n    toOrig 0\n}\n"},
        {"what cannot be read is copied as it stands",
         "gravity;\n\n\nsphere {  radius 1   2 mass 1 }\n  } 12   13\ncamera ;",
         "gravity;\n\nsphere {  radius 1   2 mass 1 }\n} 12   13\ncamera;\n"},
        {"unknown names are laid out all the same", "teapot{spout 1,2,3lid open}",
         "teapot { spout 1, 2, 3  lid open }\n"},
        {"lines that end with CR LF still do", "gravity;camera;\r\n", "gravity;\r\ncamera;\r\n"},
        {"mixed line ends become LF", "gravity;\r\ncamera;\n", "gravity;\ncamera;\n"},
        {"a byte order mark stays in front", "\xEF\xBB\xBF gravity ;", "\xEF\xBB\xBFgravity;\n"},
    };
    return rows;
}

class FormatterTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aTextHasOneLayout_data() {
        QTest::addColumn<QString>("source");
        QTest::addColumn<QString>("formatted");
        for (const Layout& row : layouts())
            QTest::newRow(row.name) << QString::fromStdString(row.source)
                                    << QString::fromStdString(row.formatted);
    }
    void aTextHasOneLayout() {
        QFETCH(QString, source);
        QFETCH(QString, formatted);
        const std::string once = formatText(carom::analyse(source.toStdString()));
        QCOMPARE(once, formatted.toStdString());
        QCOMPARE(formatText(carom::analyse(once)), once);
    }

    void theExamplesOfTheSchemaAreInTheCanonicalLayout() {
        for (const carom::DeclarationRow& row : carom::schema()) {
            const std::string example = std::string(row.example) + "\n";
            QCOMPARE(formatText(carom::analyse(example)), example);
        }
    }

    void aTextTooLargeToReadIsLeftAlone() {
        const std::string large(carom::largestText + 1, ' ');
        QVERIFY(formatText(carom::analyse(large)) == large);
    }
};

} // namespace

CAROM_TEST(formatter_test, FormatterTest)
#include "formatter_test.moc"
