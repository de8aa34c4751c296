// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/sentence.h"

#include "tests/support/test_class.h"

#include <QTest>

namespace carom {

class SentenceTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void valuesGoWhereTheirNumbersStand() {
        QCOMPARE((Sentence{"%2 and %1, and %2 again", {"a", "b"}}).text(),
                 std::string("b and a, and b again"));
        QCOMPARE((Sentence{"50 % of it", {}}).text(), std::string("50 % of it"));
        QCOMPARE((Sentence{"all: %1", {"100 %1"}}).text(), std::string("all: 100 %1")); // once only
    }

    void sentencesAreJoinedInTheirOrder() {
        QVERIFY(Reason().empty());
        Reason reason = Sentence{"%1 moves", {"it"}};
        reason.add(Sentence{"method `%1`", {"contacts"}});
        reason.add(Sentence{"nothing bounces"}, ": ");
        QCOMPARE(reason.text(), std::string("it moves; method `contacts`: nothing bounces"));
        QCOMPARE(reason.parts().size(), std::size_t{3});
    }
};

} // namespace carom

CAROM_TEST(sentence_test, carom::SentenceTest)
#include "sentence_test.moc"
