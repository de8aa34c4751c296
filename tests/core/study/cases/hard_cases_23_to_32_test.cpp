// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/study/cases/hard_cases.h"

namespace carom {

class HardCasesTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void itHoldsOrIsKnownToFail_data() { test::addTrials(23, 32); }
    void itHoldsOrIsKnownToFail() { test::judgeTrial(); }
};

} // namespace carom

QTEST_GUILESS_MAIN(carom::HardCasesTest)
#include "hard_cases_23_to_32_test.moc"
