// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/effects/effect.h"
#include "tests/support/test_class.h"

#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QRegularExpression>
#include <QTest>

#include <algorithm>
#include <map>
#include <vector>

// The rules of the sources that a compiler does not hold: which layer may include which, no Qt in core, no
// two types of one name, no file without its licence line, no file that has outgrown one reading. Works on
// the sources as they are.

namespace {

using carom::EffectRow;
using carom::effects;

// The layers from the lowest up. Modules of one row are siblings: they do not include each other.
const std::vector<QStringList> layers = {
    {"core/base"},
    {"core/math"},
    {"core/shapes"},
    {"core/scene"},
    {"core/language", "core/generators", "core/broadphase", "core/narrowphase"},
    {"core/dynamics"},
    {"core/effects", "core/integrators", "core/solvers"},
    {"core/simulation"},
    {"core/expectations"},
    {"core/study", "core/player"},
    {"ui/base"},
    {"ui/widgets"},
    {"ui/editor", "ui/viewport", "ui/player"},
    {"ui/docks"},
    {"ui/window"},
    {"app"},
};

struct Module {
    int layer = -1;
    QString name;
};

Module moduleOf(const QString& path) {
    for (int layer = 0; layer < static_cast<int>(layers.size()); ++layer)
        for (const QString& name : layers[static_cast<std::size_t>(layer)])
            if (path.startsWith(name + '/')) return {layer, name};
    return {};
}

QStringList filesBelow(const QStringList& folders, const QStringList& patterns) {
    const QDir root(QStringLiteral(CAROM_SOURCE_DIR));
    QStringList files;
    for (const QString& folder : folders) {
        QDirIterator walk(root.filePath(folder), patterns, QDir::Files, QDirIterator::Subdirectories);
        while (walk.hasNext()) files << root.relativeFilePath(walk.next());
    }
    files.sort();
    return files;
}

QString read(const QString& path) {
    QFile file(QDir(QStringLiteral(CAROM_SOURCE_DIR)).filePath(path));
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

struct Include {
    bool quoted = false;
    QString path;
};

std::vector<Include> includesOf(const QString& source) {
    static const QRegularExpression line(R"(^\s*#\s*include\s*(["<])([^">]+)[">])",
                                         QRegularExpression::MultilineOption);
    std::vector<Include> includes;
    QRegularExpressionMatchIterator found = line.globalMatch(source);
    while (found.hasNext()) {
        const QRegularExpressionMatch match = found.next();
        includes.push_back({match.captured(1) == QLatin1String("\""), match.captured(2)});
    }
    return includes;
}

// The sentence about an include that breaks a rule, or nothing.
QString complaintAbout(const QString& file, const Include& include) {
    const Module from = moduleOf(file);
    const bool inCore = file.startsWith(QLatin1String("core/"));
    static const QRegularExpression qt(R"(^(Q[A-Z]|Qt|Qsci|qcustomplot))");
    if (inCore && qt.match(include.path).hasMatch()) return "core includes Qt: " + include.path;
    if (include.path == QLatin1String("QtWidgets")) return "a whole module instead of single headers";
    if (!include.quoted || include.path.endsWith(QLatin1String(".moc"))) return {};
    if (include.path == QStringLiteral("moc_") + file.section('/', -1))
        return {}; // what moc makes of its header
    const Module to = moduleOf(include.path);
    if (to.layer < 0) return "a path that does not start at a layer: " + include.path;
    if (!QFile::exists(QDir(QStringLiteral(CAROM_SOURCE_DIR)).filePath(include.path)))
        return "no such file: " + include.path;
    if (to.name == from.name) return {};
    if (to.layer > from.layer) return "includes upward: " + include.path;
    if (to.layer == from.layer) return "includes a sibling: " + include.path;
    return {};
}

// The types that a header defines outside of others, with their namespaces.
QStringList typesIn(const QString& header) {
    static const QRegularExpression line(
        R"(^(?:namespace ([\w:]+) \{|(?:class|struct|enum class) (?:alignas\(\w+\) )?(\w+)[^;\n]*\{))",
        QRegularExpression::MultilineOption);
    QStringList types;
    QString within;
    QRegularExpressionMatchIterator found = line.globalMatch(header);
    while (found.hasNext()) {
        const QRegularExpressionMatch match = found.next();
        if (match.captured(2).isEmpty())
            within = match.captured(1);
        else
            types << within + "::" + match.captured(2);
    }
    return types;
}

QString withoutComments(QString source) {
    static const QRegularExpression comment("//[^\n]*");
    return source.remove(comment);
}

// Whether code outside an effect knows it by name. Some names are words of the language, too: a parameter of
// bodies, one of `simulation`, an option of generators, two declarations with types of their own. Writing
// them is not naming an effect; comparing with them is, except where a text or a parameter is read.
bool namesTheEffect(const QString& code, const QString& effect, const QString& file) {
    static const QStringList alsoWords = {"rotation", "broadphase", "friction", "gravity", "spring"};
    const QString text = '"' + effect + '"';
    if (!alsoWords.contains(effect)) return code.contains(text);
    if (file.startsWith(QLatin1String("core/language/"))) return false;
    return code.contains(QRegularExpression("(?<!parameter )== ?" + text + '|' + text + " ?=="));
}

} // namespace

class LayersTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void layersIncludeOnlyDownward() {
        const QStringList files = filesBelow({"core", "ui", "app"}, {"*.h", "*.cpp", "*.def"});
        QVERIFY2(files.size() > 40, "the sources were not found");
        QStringList complaints;
        for (const QString& file : files) {
            QVERIFY2(moduleOf(file).layer >= 0, qPrintable(file + " is in no module of a layer"));
            for (const Include& include : includesOf(read(file))) {
                const QString complaint = complaintAbout(file, include);
                if (!complaint.isEmpty()) complaints << file + ": " + complaint;
            }
        }
        QVERIFY2(complaints.isEmpty(), qPrintable(complaints.join('\n')));
    }

    void theCheckSeesWhatItMustSee_data() {
        QTest::addColumn<QString>("file");
        QTest::addColumn<QString>("include");
        QTest::addColumn<bool>("quoted");
        QTest::addColumn<bool>("allowed");
        QTest::newRow("down") << "core/shapes/x.cpp"
                              << "core/math/types.h" << true << true;
        QTest::newRow("same module") << "core/math/pose.h"
                                     << "core/math/types.h" << true << true;
        QTest::newRow("up") << "core/math/pose.h"
                            << "core/shapes/shape.h" << true << false;
        QTest::newRow("sibling") << "core/language/x.cpp"
                                 << "core/broadphase/broadphase.h" << true << false;
        QTest::newRow("up in ui") << "ui/editor/x.cpp"
                                  << "ui/window/main_window.h" << true << false;
        QTest::newRow("sibling in ui") << "ui/viewport/x.cpp"
                                       << "ui/editor/scene_editor.h" << true << false;
        QTest::newRow("down in ui") << "ui/docks/x.cpp"
                                    << "ui/base/theme.h" << true << true;
        QTest::newRow("Qt in core") << "core/base/x.h"
                                    << "QString" << false << false;
        QTest::newRow("Qt in ui") << "ui/window/x.h"
                                  << "QString" << false << true;
        QTest::newRow("relative") << "core/math/pose.h"
                                  << "types.h" << true << false;
        QTest::newRow("missing") << "core/shapes/x.cpp"
                                 << "core/math/no_such.h" << true << false;
    }
    void theCheckSeesWhatItMustSee() {
        QFETCH(QString, file);
        QFETCH(QString, include);
        QFETCH(bool, quoted);
        QFETCH(bool, allowed);
        QCOMPARE(complaintAbout(file, {quoted, include}).isEmpty(), allowed);
    }

    void anEffectIsKnownByNameInItsOwnFileAlone() {
        // What others need to know of a scene they ask the bodies, to which effects contribute, or all rows
        // of the table. Only effect.cpp reaches the rows by the names that the code has for them.
        static const QRegularExpression line(R"(CAROM_EFFECT\(\w+Row, \w+, (?:CAROM_OWN_ACCOUNT\((\w+))?)");
        QStringList reaching = {"extern const EffectRow", "(?:simulates|findEffect)\\(\\s*\""};
        QRegularExpressionMatchIterator lines = line.globalMatch(read("core/scene/effects.def"));
        while (lines.hasNext())
            if (const QString account = lines.next().captured(1); !account.isEmpty())
                reaching << "LedgerAccount::" + account + "\\b";
        QCOMPARE(reaching.size(), 3); // air has an account of its own
        QStringList naming;
        for (const QString& file : filesBelow({"core", "ui", "app"}, {"*.h", "*.cpp"})) {
            if (file.startsWith(QLatin1String("core/effects/"))) continue;
            const QString code = withoutComments(read(file));
            if (code.contains(QRegularExpression(reaching.join('|')))) naming << file;
            for (const EffectRow& row : effects()) {
                const QString name =
                    QString::fromUtf8(row.name.data(), static_cast<qsizetype>(row.name.size()));
                if (namesTheEffect(code, name, file)) naming << file + ": " + name;
            }
        }
        for (const EffectRow& row : effects()) {
            const QString name = QString::fromUtf8(row.name.data(), static_cast<qsizetype>(row.name.size()));
            for (const QString& file : filesBelow({"core/effects"}, {"*.cpp"}))
                if (file.section('/', -1) != name + ".cpp" &&
                    namesTheEffect(withoutComments(read(file)), name, file))
                    naming << file + ": " + name;
        }
        QVERIFY2(naming.isEmpty(), qPrintable(naming.join('\n')));
    }

    void theCheckSeesTheNameOfAnEffect() {
        QVERIFY(namesTheEffect("if (row.name == \"collision\") say();", "collision", "core/x.cpp"));
        QVERIFY(namesTheEffect("if (pipeline.simulates(\"resting\")) skip();", "resting", "core/x.cpp"));
        QVERIFY(namesTheEffect("if (row.name == \"gravity\") fall();", "gravity", "core/simulation/x.cpp"));
        QVERIFY(!namesTheEffect("if (parameter == \"rotation\") turn();", "rotation", "ui/x.cpp"));
        QVERIFY(!namesTheEffect("open(\"gravity\");", "gravity", "core/generators/x.cpp"));
        QVERIFY(!namesTheEffect("if (word == \"gravity\") read();", "gravity", "core/language/x.cpp"));
        QCOMPARE(withoutComments("a // \"resting\"\nb"), QStringLiteral("a \nb"));
    }

    // The linker takes one of two constructors of the same name for both, without a word.
    void noTwoTypesHaveOneName() {
        std::map<QString, QStringList> headers; // by type
        for (const QString& file : filesBelow({"core", "ui", "app"}, {"*.h"}))
            for (const QString& type : typesIn(read(file))) headers[type] << file;
        QVERIFY(headers.size() > 300);
        QStringList twice;
        for (const auto& [type, files] : headers)
            if (files.size() > 1) twice << type + ": " + files.join(", ");
        QVERIFY2(twice.isEmpty(), qPrintable(twice.join('\n')));
    }

    void theCheckSeesTypesAndTheirNamespaces() {
        const QString header =
            "namespace a {\nclass One;\nclass One final : public Zero {\n    struct Part {\n"
            "};\nstruct alignas(32) Two { int x; };\n} // namespace a\nnamespace a::b {\nenum class One : "
            "int { X };\n}\n";
        QCOMPARE(typesIn(header), QStringList({"a::One", "a::Two", "a::b::One"}));
    }

    void everySourceOpensWithItsLicence() {
        QStringList bare;
        for (const QString& file : filesBelow({"core", "ui", "app", "tests"}, {"*.h", "*.cpp", "*.def"}))
            if (!read(file).startsWith(QLatin1String("// SPDX-License-Identifier: GPL-3.0-or-later\n")))
                bare << file;
        QVERIFY2(bare.isEmpty(), qPrintable(bare.join('\n')));
    }

    void noFileHasOutgrownOneReading() {
        constexpr qsizetype mostLines = 600;
        QStringList outgrown;
        for (const QString& file : filesBelow({"core", "ui", "app", "tests"}, {"*.h", "*.cpp"}))
            if (read(file).count('\n') > mostLines) outgrown << file;
        QVERIFY2(outgrown.isEmpty(), qPrintable(outgrown.join('\n')));
    }

    void everyTestIsRun() {
        // A test that is not listed would never fail: each stands in its folder's CMakeLists.txt or the one
        // above.
        QStringList unlisted;
        for (const QString& file : filesBelow({"tests"}, {"*_test.cpp"})) {
            const QString name = file.section('/', -1).chopped(4);
            const QString folder = file.section('/', 0, -2);
            const QString lists = read(folder + "/CMakeLists.txt") + read(folder + "/../CMakeLists.txt");
            if (!lists.contains(QRegularExpression("\\b" + name + "\\b"))) unlisted << file;
        }
        QVERIFY2(unlisted.isEmpty(), qPrintable(unlisted.join('\n')));
    }

    void everyHeaderOfTheSolversIsHeldByATest() {
        // By the one of its name, or by those that tests/README.md names in a row for it.
        const QString manual = read("tests/README.md");
        QStringList bare;
        for (const QString& file : filesBelow({"core/solvers"}, {"*.h"})) {
            const QString name = file.chopped(2);
            if (!read("tests/" + name + "_test.cpp").isEmpty()) continue;
            const QString entry = '`' + name.section('/', 2) + '`';
            const QRegularExpression row("^\\| [^|]*" + entry + "[^|]*\\|([^|]*)\\|$",
                                         QRegularExpression::MultilineOption);
            static const QRegularExpression named("`([\\w/]+_test)`");
            int tests = 0;
            QRegularExpressionMatchIterator test = named.globalMatch(row.match(manual).captured(1));
            while (test.hasNext()) {
                const QString path = "tests/" + test.next().captured(1) + ".cpp";
                tests += read(path).isEmpty() ? -100 : 1;
            }
            if (tests <= 0) bare << file;
        }
        QVERIFY2(bare.isEmpty(), qPrintable(bare.join('\n')));
    }

    void everySourceIsBuilt() {
        // An unlisted file would rot unseen: each .cpp stands in its folder's CMakeLists.txt or one above.
        QStringList unlisted;
        for (const QString& file : filesBelow({"core", "ui", "app"}, {"*.cpp"})) {
            const QString name = file.section('/', -1);
            const QString folder = file.section('/', 0, -2);
            if (!read(folder + "/CMakeLists.txt").contains(name)) unlisted << file;
        }
        QVERIFY2(unlisted.isEmpty(), qPrintable(unlisted.join('\n')));
    }
};

CAROM_TEST_WITH(QCoreApplication, layers_test, LayersTest)
#include "layers_test.moc"
