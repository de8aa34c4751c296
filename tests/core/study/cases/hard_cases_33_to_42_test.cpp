// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/study/cases/hard_cases.h"
#include "tests/support/test_class.h"

namespace carom {

class HardCases33To42Test : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void itHoldsOrIsKnownToFail_data() { test::addTrials(33, 42); }
    void itHoldsOrIsKnownToFail() { test::judgeTrial(); }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, hard_cases_33_to_42_test, carom::HardCases33To42Test)
#include "hard_cases_33_to_42_test.moc"
