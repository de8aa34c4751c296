// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/stability_report.h"

#include <QObject>
#include <QTest>

#include <algorithm>
#include <array>

// The short form of every hard case, in every column it has an answer in. All hold but those listed here. The
// list is held from both sides: a case that begins to hold fails the test until it is taken off.

namespace carom::test {

struct KnownFailure {
    std::string_view name;
    StudyColumn column;
    std::string_view why; ///< with the figure, where it was measured
};

inline constexpr std::array knownFailures{
    KnownFailure{"thin_bodies", StudyColumn::Accurate, "energy rises by 4.1e-5 between two frames"},
    KnownFailure{"continuity", StudyColumn::Accurate,
                 "of crowds of six and seven bodies one takes 5.5 times the work of the other"},
};

inline bool isKnownToFail(const HardCase& hardCase, StudyColumn column) {
    return std::ranges::any_of(knownFailures, [&](const KnownFailure& failure) {
        return failure.name == hardCase.name && failure.column == column;
    });
}

/// A row for every column of the cases with these numbers; `test` reads it.
inline void addTrials(int first, int last) {
    QTest::addColumn<QByteArray>("name");
    QTest::addColumn<int>("column");
    for (const HardCase& hardCase : hardCases())
        for (const StudyColumn column : studyColumns)
            if (hardCase.has(column) && hardCase.number >= first && hardCase.number <= last) {
                const QByteArray name(hardCase.name.data(), static_cast<qsizetype>(hardCase.name.size()));
                QTest::addRow("%d %s, %s", hardCase.number, name.constData(), nameOf(column).data())
                    << name << static_cast<int>(column);
            }
}

inline void judgeTrial() {
    QFETCH(QByteArray, name);
    QFETCH(int, column);
    const HardCase& hardCase = *findHardCase(name.toStdString());
    const std::optional<TrialResult> result =
        runTrial(hardCase, static_cast<StudyColumn>(column), StudyLength::Short);
    QVERIFY(result);
    QByteArray figures;
    for (const Figure& figure : result->figures)
        figures += QByteArray(figure.holds() ? "" : "! ") + describe(figure).c_str() + "; ";
    const bool fails = isKnownToFail(hardCase, result->column);
    if (fails && result->verdict == Verdict::Holds)
        QFAIL(("it holds by now and must be taken off the list of failures: " + figures).constData());
    QVERIFY2(fails || result->verdict == Verdict::Holds, figures.constData());
}

} // namespace carom::test
