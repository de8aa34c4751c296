// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/language/analysis.h"
#include "core/language/manual.h"
#include "core/scene/schema.h"

#include <QFile>
#include <QObject>
#include <QTest>

#include <algorithm>
#include <string>

// The printed reference is the schema's; with CAROM_UPDATE set in the environment this test writes it anew.

namespace {

class ManualTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void theReferenceInTheHelpIsTheOneTheSchemaGives() {
        const QByteArray made = QByteArray::fromStdString(carom::languageManual());
        QFile file(QStringLiteral(CAROM_SOURCE_DIR "/resources/help/language.md"));
        if (qEnvironmentVariableIsSet("CAROM_UPDATE")) {
            QVERIFY(file.open(QIODevice::WriteOnly));
            QCOMPARE(file.write(made), made.size());
            return;
        }
        QVERIFY2(file.open(QIODevice::ReadOnly), "run this test with CAROM_UPDATE=1 to write it");
        QVERIFY2(file.readAll() == made,
                 "resources/help/language.md is out of date; run this test with CAROM_UPDATE=1");
    }

    void theReferenceNamesEveryDeclarationParameterAndMessage() {
        const std::string manual = carom::languageManual();
        for (const carom::DeclarationRow& row : carom::schema()) {
            QVERIFY(manual.find("\n### " + std::string(row.name)) != std::string::npos);
            for (const carom::ParameterRow& parameter : row.parameters)
                QVERIFY2(manual.find("| `" + std::string(parameter.name) + "`") != std::string::npos,
                         parameter.name.data());
        }
        for (const carom::DiagnosticCodeRow& row : carom::diagnosticCodes())
            QVERIFY2(manual.find(std::string(row.code)) != std::string::npos, row.code.data());
    }

    void everyTableRowHasItsFiveCells() {
        const std::string manual = carom::languageManual();
        const std::size_t begin = manual.find("## Declarations");
        const std::size_t end = manual.find("## Colours");
        std::size_t rows = 0;
        for (std::size_t line = begin; line < end; line = manual.find('\n', line) + 1) {
            if (manual[line] != '|') continue;
            const std::string text = manual.substr(line, manual.find('\n', line) - line);
            QVERIFY2(std::count(text.begin(), text.end(), '|') == 6, text.c_str());
            ++rows;
        }
        QVERIFY(rows > 50);
    }
};

} // namespace

CAROM_TEST(manual_test, ManualTest)
#include "manual_test.moc"
