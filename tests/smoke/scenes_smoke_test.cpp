// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/effects/effect.h"
#include "core/language/formatter.h"
#include "core/scene/schema.h"
#include "core/simulation/build.h"
#include "core/simulation/touching.h"
#include "core/simulation/world.h"

#include "tests/support/program.h"
#include "tests/support/test_class.h"

#include <QDirIterator>
#include <QRegularExpression>
#include <QTest>

#include <set>

using namespace carom;

// Every scene that is shipped is opened and run.

class ScenesSmokeTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void everySceneBuildsWithoutErrorsAndOpensWithWhatToLookFor_data() { scenes(); }
    void everySceneBuildsWithoutErrorsAndOpensWithWhatToLookFor();
    void nothingMobileOverlapsAtTheStart_data() { scenes(); }
    void nothingMobileOverlapsAtTheStart();
    void everySceneIsInTheCanonicalLayout_data() { scenes(); }
    void everySceneIsInTheCanonicalLayout();
    void everySceneRuns_data() { scenes(); }
    void everySceneRuns();
    void everyEffectHasASceneThatCallsForIt();
    void theTourShowsEveryDeclarationAndParameter();

  private:
    static constexpr int frames = 30;

    static void scenes() {
        QTest::addColumn<QString>("path");
        const QString root = test::source(QStringLiteral("scenes"));
        QDirIterator files(root, {QStringLiteral("*.sdl")}, QDir::Files, QDirIterator::Subdirectories);
        while (files.hasNext()) {
            const QString path = files.next();
            QTest::newRow(qPrintable(path.mid(root.size() + 1))) << path;
        }
    }
    /// Hard cases ask for what the editor warns of.
    static bool isHard(const QString& path) { return path.contains(QLatin1String("/scenes/hard/")); }
    /// What they are about.
    static bool isOfOverlaps(const QString& path) {
        return path.endsWith(QLatin1String("/39_deep_overlap.sdl")) ||
               path.endsWith(QLatin1String("/40_one_centre.sdl"));
    }
    static Build built(const QString& path) { return build(test::readFile(path).toStdString()); }
};

void ScenesSmokeTest::everySceneBuildsWithoutErrorsAndOpensWithWhatToLookFor() {
    QFETCH(QString, path);
    const Build scene = built(path);
    for (const Diagnostic& diagnostic : scene.diagnostics) {
        const bool mayStand = diagnostic.code == DiagnosticCode::NotSimulatedYet ||
                              (isHard(path) && diagnostic.severity() != Severity::Error);
        QVERIFY2(mayStand, formatDiagnostic(scene.analysis, diagnostic, path.toStdString()).c_str());
    }
    QVERIFY(scene.analysis.scene.camera.source);
    QVERIFY(scene.analysis.text.starts_with("// "));
    QVERIFY(scene.analysis.text.find("\n// What to look for: ") != std::string::npos);
    // Beside the picture the editor is some 72 columns wide; a command stays on its line.
    for (const QByteArray& line : test::readFile(path).split('\n'))
        if (line.contains("//") && !line.startsWith("// carom "))
            QVERIFY2(QString::fromUtf8(line).size() <= 72, line.constData());
    static const QRegularExpression withoutZero(QStringLiteral(R"(//.*[\s(=,]\.\d)"));
    for (const QByteArray& line : test::readFile(path).split('\n'))
        QVERIFY2(!withoutZero.match(QString::fromUtf8(line)).hasMatch(), line.constData());
}

void ScenesSmokeTest::nothingMobileOverlapsAtTheStart() {
    QFETCH(QString, path);
    if (isOfOverlaps(path)) return;
    // Bodies that stand on each other touch but for rounding [m]; hard cases are up to 1 km large.
    const double rounding = isHard(path) ? 1e-12 : 1e-15;
    const Build scene = built(path);
    for (const TouchingPair& pair : touchingPairs(scene.pipeline->bodies(), scene.pipeline->initialState()))
        QVERIFY2(pair.manifold.deepest().separation >= -rounding,
                 qPrintable(QStringLiteral("%1 and %2").arg(pair.pair.a).arg(pair.pair.b)));
}

void ScenesSmokeTest::everySceneIsInTheCanonicalLayout() {
    QFETCH(QString, path);
    const Analysis analysis = analyse(test::readFile(path).toStdString());
    QCOMPARE(QString::fromStdString(formatText(analysis)), QString::fromStdString(analysis.text));
}

// That every broad-phase leads to the same states is held by tests/determinism.
void ScenesSmokeTest::everySceneRuns() {
    QFETCH(QString, path);
    World world(built(path).pipeline);
    for (int frame = 0; frame < frames; ++frame) world.step();
    QVERIFY(world.health().finite);
    QCOMPARE(world.state().frame, frames);
}

void ScenesSmokeTest::everyEffectHasASceneThatCallsForIt() {
    for (const EffectRow& row : effects()) {
        const QString name = QString::fromUtf8(row.name.data(), qsizetype(row.name.size()));
        const Build scene = built(test::source(QStringLiteral("scenes/effects/%1.sdl").arg(name)));
        bool called = false;
        for (const EffectDecision& decision : scene.pipeline->effects())
            called = called || (decision.effect == row.name && decision.status != EffectStatus::Absent);
        QVERIFY2(called, qPrintable(name));
    }
}

void ScenesSmokeTest::theTourShowsEveryDeclarationAndParameter() {
    const Build tour = built(test::source(QStringLiteral("scenes/tour.sdl")));
    const Analysis& analysis = tour.analysis;
    std::set<std::string_view> declarations, parameters;
    for (const DeclarationSyntax& declaration : analysis.tree.declarations)
        declarations.insert(textOf(analysis.text, declaration.type));
    for (const ParameterSyntax& parameter : analysis.tree.parameters)
        parameters.insert(textOf(analysis.text, parameter.name));
    for (const DeclarationRow& row : schema()) {
        QVERIFY2(declarations.contains(row.name), row.name.data());
        for (const ParameterRow& parameter : row.parameters)
            QVERIFY2(parameters.contains(parameter.name), parameter.name.data());
    }
}

CAROM_TEST(scenes_smoke_test, ScenesSmokeTest)
#include "scenes_smoke_test.moc"
