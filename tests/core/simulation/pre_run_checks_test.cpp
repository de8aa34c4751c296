// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/text.h"

#include "core/simulation/build.h"

#include <QTest>

#include <algorithm>

// Warnings before the run, each with the figure that triggers it, at the value that does.

namespace carom {
namespace {
using test::q;

/// The text after the first fix-it of this code, or nothing where there is none.
QString corrected(const char* text, DiagnosticCode code) {
    const Build built = build(text);
    for (const Diagnostic& diagnostic : built.diagnostics) {
        if (diagnostic.code != code || !diagnostic.fixIt) continue;
        const TextEdit& edit = diagnostic.fixIt->edit;
        std::string result = built.analysis.text;
        result.replace(edit.range.offset, edit.range.length, edit.text);
        return q(result);
    }
    return {};
}

bool says(const QString& text, DiagnosticCode code) {
    const Build built = build(text.toStdString());
    return std::ranges::count(built.diagnostics, code, &Diagnostic::code) > 0;
}

QStringList warningsOf(const char* text) {
    const Build built = build(text);
    QStringList found;
    for (const Diagnostic& diagnostic : built.diagnostics)
        found += q(rowOf(diagnostic.code).code) + QStringLiteral(" `") +
                 q(textOf(built.analysis.text, diagnostic.range)) + QStringLiteral("`: ") +
                 q(diagnostic.message);
    return found;
}

} // namespace

class PreRunChecksTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void spheresThatOverlapAreToldByHowMuch() {
        QCOMPARE(
            warningsOf("sphere a { radius 1 mass 1 centre 0, 0, 0 }\n"
                       "sphere b { radius 1 mass 1 centre 0, 1.75, 0 }\n"),
            QStringList(QStringLiteral("sdl-overlap-at-start `0, 1.75, 0`: `b` overlaps `a` by 0.25 m at the "
                                       "start; move them apart by at least that")));
    }

    void aBodyThatSinksIntoAWallIsNamedNotTheWall() {
        QCOMPARE(
            warningsOf("sphere a { radius 1 mass 1 centre 0, 0.5, 0 }\nwall { normal 0, 1, 0 toOrig 0 }\n"),
            QStringList(QStringLiteral("sdl-overlap-at-start `0, 0.5, 0`: `a` overlaps wall 1 by 0.5 m at "
                                       "the start; move them apart by at least that")));
    }

    void aBodyBehindAWallIsToldHowFar() {
        QCOMPARE(
            warningsOf("wall { normal 0, 1, 0 toOrig 0 }\nsphere a { radius 1 mass 1 centre 0, -3, 0 }\n"),
            QStringList(
                QStringLiteral("sdl-outside-walls `0, -3, 0`: the centre of `a` is 3 m behind wall 0; "
                               "the free side is the one the normal points to")));
    }

    void aSpringTooStiffForTheIntegratorIsToldTheSubstepsThatHoldIt() {
        const QString stiff = QStringLiteral("sphere a { radius 1 mass 1 centre 0, 0, 0 }\n"
                                             "spring { from world to a stiffness 90000 length 1 }\n"
                                             "simulation { step 0.01 method %1 }\n");
        const auto told = [&](const char* method) {
            return warningsOf(stiff.arg(QLatin1StringView(method)).toUtf8().constData());
        };
        QCOMPARE(
            told("microcollisions integrator verlet"),
            QStringList(QStringLiteral(
                "sdl-unstable-spring `spring`: the oscillation of this spring grows without bound: ωh "
                "is 3, and `verlet` holds up to 2; `substeps 2` or `integrator midpoint` would hold it")));
        QCOMPARE(told("microcollisions integrator euler"),
                 QStringList(QStringLiteral(
                     "sdl-unstable-spring `spring`: the oscillation of this spring grows without bound: ωh "
                     "is 3, and `euler` holds none that is not damped; `integrator verlet` or `midpoint` "
                     "would hold it")));
        QCOMPARE(told("contacts integrator midpoint"), QStringList());
        QCOMPARE(told("microcollisions integrator verlet substeps 2"), QStringList());
    }

    // k = ½ ρ C A/m = 188.5/m, so that 2 k v h = 7540 · 0.01 at 20 m/s.
    void aForceTooStrongForAnExplicitIntegratorIsToldTheSubstepsThatHoldIt() {
        const QString shot =
            QStringLiteral("air { density 1.2 }\ngravity { accel 0, 0, 0 }\n"
                           "sphere feather { radius 1 mass 0.01 centre 0, 0, 0 vel 20, 0, 0 drag 1 }\n"
                           "sphere steel { radius 1 mass 1e6 centre 9, 0, 0 vel 0, 20, 0 drag 1 }\n"
                           "simulation { step 0.01 method %1 }\n");
        const auto told = [&](const char* method) {
            return warningsOf(shot.arg(QLatin1StringView(method)).toUtf8().constData());
        };
        QCOMPARE(
            told("contacts substeps 1 integrator euler"),
            QStringList(QStringLiteral(
                "sdl-unstable-force `1`: `drag` may throw `feather` back and forth: λh is 75.4, and `euler` "
                "holds up to 2; `substeps 38` or `integrator midpoint` would hold it")));
        QCOMPARE(told("contacts substeps 38 integrator euler"), QStringList());
        QCOMPARE(told("contacts substeps 1"), QStringList());
    }

    void bodiesThatOnlyTouchAreFine() {
        QCOMPARE(warningsOf("wall { normal 0, 1, 0 toOrig 0 }\n"
                            "sphere { radius 0.1 mass 1 centre 0, 0.1, 0 }\n"
                            "sphere { radius 0.1 mass 1 centre 0, 0.3, 0 }\n"
                            "cylinder { radius 0.3 height 0.7 mass 1 centre 2, 0.35, 0 axis 0, 1, 0 }\n"
                            "cylinder { radius 0.3 height 0.7 mass 1 centre 2, 1.05, 0 axis 0, 1, 0 }\n"),
                 QStringList());
    }

    void fixedBodiesMayOverlapEachOther() {
        QCOMPARE(warningsOf("wall { normal 0, 1, 0 toOrig 0 }\n"
                            "sphere { radius 1 centre 0, 0.5, 0 fixed yes }\n"
                            "sphere { radius 1 centre 0, 1, 0 fixed yes }\n"),
                 QStringList());
    }

    // 8 m/s for 1/60 s is 0.133 m, five times the cue ball's radius.
    void aBodyThatMayTunnelIsToldTheSubstepsThatHoldIt() {
        QCOMPARE(
            warningsOf("simulation { method microcollisions }\n"
                       "sphere cue { radius 0.027 mass 1 centre 0, 0, 0 vel 8, 0, 0 }\n"
                       "sphere { radius 1 mass 1 centre 5, 0, 0 }\n"),
            QStringList(QStringLiteral("sdl-tunnelling `8, 0, 0`: `cue` moves 0.133 m a substep, more than "
                                       "its half-extent of 0.027 m, and may pass through what it meets; "
                                       "`substeps 5` would hold it")));
        QCOMPARE(warningsOf("simulation { method microcollisions substeps 5 }\n"
                            "sphere cue { radius 0.027 mass 1 centre 0, 0, 0 vel 8, 0, 0 }\n"
                            "sphere { radius 1 mass 1 centre 5, 0, 0 }\n"),
                 QStringList());
        // The default method locates impacts: nothing tunnels.
        QCOMPARE(warningsOf("sphere cue { radius 0.027 mass 1 centre 0, 0, 0 vel 8, 0, 0 }\n"
                            "sphere { radius 1 mass 1 centre 5, 0, 0 }\n"),
                 QStringList());
    }

    void aLoneBodyMayBeAsFastAsItLikes() {
        QCOMPARE(warningsOf("sphere { radius 0.1 mass 1 centre 0, 0, 0 vel 1e9, 0, 0 }"), QStringList());
    }

    void everyFixItLeavesNothingToFix_data() {
        QTest::addColumn<QByteArray>("text");
        QTest::addColumn<int>("code");
        const auto add = [](const char* name, const char* text, DiagnosticCode code) {
            QTest::newRow(name) << QByteArray(text) << static_cast<int>(code);
        };
        add("overlap of spheres",
            "sphere { radius 1 mass 1 centre 0, 0, 0 }\nsphere { radius 1 mass 1 centre 0.3, 1.7, 1000 }\n"
            "sphere { radius 1 mass 1 centre 0.3, 1.1, 1000 }\n",
            DiagnosticCode::OverlapAtStart);
        add("overlap with a wall",
            "cuboid { size 1, 1, 1 mass 1 centre 0, 0.3, 0 rotation 10, 20, 30 }\nwall { normal 0, 1, 0 "
            "toOrig 0 }",
            DiagnosticCode::OverlapAtStart);
        const char* fast = "sphere { radius 0.1 mass 1 centre 0, 0, 0 vel 60, 0, 0 }\n"
                           "sphere { radius 1 mass 1 centre 5, 0, 0 }\n";
        static std::string texts[3];
        texts[0] = std::string("simulation { method microcollisions }\n") + fast;
        texts[1] = std::string("simulation { method microcollisions  substeps 2 }\n") + fast;
        add("fast, no substeps", texts[0].c_str(), DiagnosticCode::Tunnelling);
        add("fast, too few substeps", texts[1].c_str(), DiagnosticCode::Tunnelling);
        add("heavy on light",
            "simulation { method microcollisions }\nsphere { radius 1 mass 1 centre 0, 0, 0 }\n"
            "sphere { radius 1 mass 5000 centre 0, 2, 0 }\n",
            DiagnosticCode::MassRatio);
        texts[2] = "wall { normal 0, 1, 0 toOrig 0 }\nsphere { radius 1 mass 1e6 centre 0, 501, 0 }\n";
        for (int i = 0; i < 250; ++i)
            texts[2] += "sphere { radius 1 mass 1 centre 0, " + std::to_string(2 * i + 1) + ", 0 }\n";
        texts[2] += "simulation { method contacts }";
        add("heavy on a pile", texts[2].c_str(), DiagnosticCode::MassRatio);
        add("drag under explicit Euler",
            "air { density 1.2 }\nsimulation { integrator euler }\n"
            "sphere { radius 1 mass 0.01 centre 0, 0, 0 vel 20, 0, 0 drag 1 }",
            DiagnosticCode::UnstableForce);
        add("fixed and moving",
            "cylinder { radius 1 height 1 axis 0, 1, 0 centre 0, 0, 0 fixed yes vel 1, 0, 0 }",
            DiagnosticCode::WithoutEffect);
    }
    void everyFixItLeavesNothingToFix() {
        QFETCH(QByteArray, text);
        QFETCH(int, code);
        const auto wanted = static_cast<DiagnosticCode>(code);
        QVERIFY(says(QString::fromUtf8(text), wanted));
        const QString after = corrected(text.constData(), wanted);
        QVERIFY(!after.isEmpty());
        const Build built = build(after.toStdString());
        QVERIFY2(built.analysis.diagnostics.empty(), qPrintable(after));
        QVERIFY2(!says(after, wanted), qPrintable(after));
    }

    void settingsAreWrittenWhereTheyBelong() {
        const char* fast = "// fast\nsphere { radius 0.1 mass 1 centre 0, 0, 0 vel 60, 0, 0 }\n"
                           "sphere { radius 1 mass 1 centre 5, 0, 0 }\n%1";
        const auto after = [&](const char* simulation) {
            const QByteArray text =
                QString(QLatin1StringView(fast)).arg(QLatin1StringView(simulation)).toUtf8();
            return corrected(text.constData(), DiagnosticCode::Tunnelling).section('\n', -1);
        };
        QCOMPARE(after("simulation { method microcollisions }"),
                 QStringLiteral("simulation { method microcollisions  substeps 10 }"));
        QCOMPARE(after("simulation { substeps 3 method microcollisions }"),
                 QStringLiteral("simulation { substeps 12 method microcollisions }"));
    }

    void aHeavyBodyOnALightOneIsToldWhatHoldsIt() {
        QCOMPARE(
            warningsOf("simulation { method microcollisions }\n"
                       "sphere light { radius 1 mass 1 centre 0, 0, 0 }\n"
                       "sphere heavy { radius 1 mass 2500 centre 0, 2, 0 }\n"),
            QStringList(QStringLiteral(
                "sdl-mass-ratio `2500`: `heavy` is 2.5e+03 times as heavy as `light`, which it touches; "
                "`microcollisions` meets each pair once a substep and lets it sink in, `method contacts` "
                "would hold it")));
        QCOMPARE(warningsOf("simulation { method microcollisions }\n"
                            "sphere light { radius 1 mass 1 centre 0, 0, 0 }\n"
                            "sphere heavy { radius 1 mass 2500 centre 0, 2.01, 0 }\n"),
                 QStringList());
        QCOMPARE(warningsOf("simulation { method contacts }\n"
                            "sphere light { radius 1 mass 1 centre 0, 0, 0 }\n"
                            "sphere heavy { radius 1 mass 2500 centre 0, 2, 0 }\n"),
                 QStringList());
    }

    void whatIsSaidInVainIsHintedAt() {
        QCOMPARE(
            warningsOf("sphere post { radius 1 centre 0, 0, 0 fixed yes vel 1, 0, 0 }\n"),
            QStringList(QStringLiteral("sdl-without-effect `1, 0, 0`: `vel` has no effect: `post` is fixed; "
                                       "only what is not fixed moves")));
        QCOMPARE(
            warningsOf("wall { normal 0, 1, 0 toOrig 0 }\n"
                       "sphere ball { radius 1 mass 1 centre 0, 2, 0 friction 0.5 }\n"),
            QStringList(QStringLiteral(
                "sdl-without-effect `0.5`: `friction` has no effect: a pair has the geometric mean of its "
                "two, and no body that `ball` can meet has any; give the others friction too")));
        QCOMPARE(
            warningsOf("sphere post { radius 1 centre 0, 0, 0 fixed yes }\n"
                       "spring { from world to post stiffness 1 fromAt 0, 5, 0 }\n"),
            QStringList(QStringLiteral("sdl-without-effect `spring`: this spring has no effect: neither of "
                                       "its ends can move; tie it to a body that is not fixed")));
    }

    void theBodiesThatWarningsStandAtAreKnown() {
        const Build built = build("wall { normal 0, 1, 0 toOrig 0 }\n"
                                  "sphere { radius 1 mass 1 centre 9, 5, 0 }\n"
                                  "sphere { radius 1 mass 1 centre 0, 5, 0 }\n"
                                  "sphere { radius 1 mass 1 centre 0, 6, 0 }\n"
                                  "sphere { radius 1 centre 20, 5, 0 fixed yes vel 1, 0, 0 }\n"
                                  "sphere { radius 1 mass 1 centre 0, -5, 0 }\n");
        QVERIFY(built.pipeline->warnedBodies() == (std::vector<BodyIndex>{3, 5}));
    }

    // Ten thousand bodies in one place have fifty million pairs.
    void aHeapOfOverlapsDoesNotBecomeAnAvalanche() {
        std::string text;
        for (int i = 0; i < 10000; ++i) text += "sphere { radius 1 mass 1 centre 0, 0, 0 }\n";
        QCOMPARE(warningsOf(text.c_str()).size(), 50);
    }
};

} // namespace carom

CAROM_TEST(pre_run_checks_test, carom::PreRunChecksTest)
#include "pre_run_checks_test.moc"
