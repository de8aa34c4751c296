// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/study/cases/hard_cases.h"
#include "tests/support/test_class.h"

namespace carom {

class HardCases51To56Test : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void itHoldsOrIsKnownToFail_data() { test::addTrials(51, 56); }
    void itHoldsOrIsKnownToFail() { test::judgeTrial(); }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, hard_cases_51_to_56_test, carom::HardCases51To56Test)
#include "hard_cases_51_to_56_test.moc"
