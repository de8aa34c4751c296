// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/study/cases/hard_cases.h"

namespace carom {

class HardCasesTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void itHoldsOrIsKnownToFail_data() { test::addTrials(43, 50); }
    void itHoldsOrIsKnownToFail() { test::judgeTrial(); }
};

} // namespace carom

QTEST_GUILESS_MAIN(carom::HardCasesTest)
#include "hard_cases_43_to_50_test.moc"
