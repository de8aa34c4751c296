// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/build.h"

#include <QTest>

// Warnings before the run, each with the figure that triggers it, at the value that does.

namespace carom {
namespace {

QString q(std::string_view text) { return QString::fromUtf8(text.data(), qsizetype(text.size())); }

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

class ForesightTest : public QObject {
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
                                             "simulation { step 0.01 integrator %1 }\n");
        const auto told = [&](const char* integrator) {
            return warningsOf(stiff.arg(QLatin1StringView(integrator)).toUtf8().constData());
        };
        QCOMPARE(
            told("verlet"),
            QStringList(QStringLiteral(
                "sdl-unstable-spring `spring`: the oscillation of this spring grows without bound: ωh "
                "is 3, and `verlet` holds up to 2; `substeps 2` or `integrator midpoint` would hold it")));
        QCOMPARE(told("euler"),
                 QStringList(QStringLiteral(
                     "sdl-unstable-spring `spring`: the oscillation of this spring grows without bound: ωh "
                     "is 3, and `euler` holds none that is not damped; `integrator verlet` or `midpoint` "
                     "would hold it")));
        QCOMPARE(told("midpoint method contacts"), QStringList());
        QCOMPARE(told("verlet substeps 2"), QStringList());
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

    // Ten thousand bodies in one place have fifty million pairs.
    void aHeapOfOverlapsDoesNotBecomeAnAvalanche() {
        std::string text;
        for (int i = 0; i < 10000; ++i) text += "sphere { radius 1 mass 1 centre 0, 0, 0 }\n";
        QCOMPARE(warningsOf(text.c_str()).size(), 50);
    }
};

} // namespace carom

QTEST_APPLESS_MAIN(carom::ForesightTest)
#include "foresight_test.moc"
