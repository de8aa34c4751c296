// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/study/cases/hard_cases.h"
#include "tests/support/test_class.h"

namespace carom {

class HardCases57To63Test : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void itHoldsOrIsKnownToFail_data() { test::addTrials(57, 63); }
    void itHoldsOrIsKnownToFail() { test::judgeTrial(); }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, hard_cases_57_to_63_test, carom::HardCases57To63Test)
#include "hard_cases_57_to_63_test.moc"
