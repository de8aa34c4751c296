// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/expectations/scene_check.h"
#include "core/simulation/build.h"

#include "tests/support/test_class.h"

#include <QTest>

// How long a scene is run to judge it, and that it can be ended.

using namespace carom;

namespace {

std::int64_t framesOf(const std::string& declarations, std::optional<double> mostOpen = {}) {
    const Build built = build("sphere ball { radius 1  mass 1  centre 0, 0, 0 }\n" + declarations);
    return framesToJudge(*built.pipeline, ExpectationWatch(built.pipeline), mostOpen);
}

} // namespace

class SceneCheckTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aSceneRunsForItsDurationOrUntilTheLastMomentThatIsNamed() {
        QCOMPARE(framesOf(""), 0);
        QCOMPARE(framesOf("expect { quantity y  at 2  max 1 }"), 120);
        QCOMPARE(framesOf("expect { quantity y  until 2  max 1 }\nexpect { quantity y  at 2.01  max 1 }"),
                 121);
        QCOMPARE(framesOf("expect { quantity y  max 1 }"), 600);
        QCOMPARE(framesOf("expect { quantity y  from 20  max 1 }"), 1200);
        QCOMPARE(framesOf("simulation { duration 3 }\nexpect { quantity y  at 2  max 1 }"), 180);
        QCOMPARE(framesOf("simulation { duration 3 }\nexpect { quantity y  at 4  max 1 }"), 180);
    }

    void whatIsOpenCanBeCutButNotWhatIsNamed() {
        QCOMPARE(framesOf("expect { quantity y  max 1 }", 2), 120);
        QCOMPARE(framesOf("expect { quantity y  at 4  max 1 }", 2), 240);
        QCOMPARE(framesOf("simulation { duration 1 }\nexpect { quantity y  max 1 }", 2), 60);
    }

    void itEndsWhenToldTo() {
        const Build built =
            build("sphere ball { radius 1  mass 1  centre 0, 0, 0 }\nexpect { quantity y  max 1 }");
        int asked = 0;
        QVERIFY(!checkScene(built.pipeline, [&] { return ++asked < 10; }));
        QCOMPARE(asked, 10);
    }
};

CAROM_TEST(scene_check_test, SceneCheckTest)
#include "scene_check_test.moc"
