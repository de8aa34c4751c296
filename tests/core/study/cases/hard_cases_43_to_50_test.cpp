// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/study/cases/hard_cases.h"
#include "tests/support/test_class.h"

namespace carom {

class HardCases43To50Test : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void itHoldsOrIsKnownToFail_data() { test::addTrials(43, 50); }
    void itHoldsOrIsKnownToFail() { test::judgeTrial(); }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, hard_cases_43_to_50_test, carom::HardCases43To50Test)
#include "hard_cases_43_to_50_test.moc"
