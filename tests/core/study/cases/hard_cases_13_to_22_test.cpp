// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/study/cases/hard_cases.h"
#include "tests/support/test_class.h"

namespace carom {

class HardCases13To22Test : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void itHoldsOrIsKnownToFail_data() { test::addTrials(13, 22); }
    void itHoldsOrIsKnownToFail() { test::judgeTrial(); }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, hard_cases_13_to_22_test, carom::HardCases13To22Test)
#include "hard_cases_13_to_22_test.moc"
