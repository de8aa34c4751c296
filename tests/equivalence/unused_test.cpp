// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/counted_frames.h"
#include "tests/support/random_scene.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include "core/simulation/build.h"

#include <QMap>
#include <QRegularExpression>
#include <QSet>
#include <QTest>

#include <algorithm>
#include <utility>

// What a scene does not use costs nothing: not an instruction, not a call. valgrind counts them, so the
// figures are the same on every machine, however busy. What is the same about the motion is specialised_test.

namespace carom {
namespace {

using namespace test;

/// What the counted frames of a scene took.
struct Profile {
    quint64 instructions = 0; ///< but those of the C library
    QSet<QString> functions;  ///< that were called
    QString hash;             ///< of the state at the end
};

/// By then every list has its size.
constexpr int framesBefore = 60, framesCounted = 12;

/// What a callgrind file tells. A name stands where it comes first, `fn=(7) carom::step(World&)`, and a
/// number afterwards; under `ob=`, the program or a library, and `fn=` come the costs, `line cost`, and
/// behind a line `calls=` what was called took in all. The C library's own are left out: what it takes to
/// copy or to allocate depends on where in memory that is.
Profile readProfile(const QString& path) {
    static const QRegularExpression entry(QStringLiteral("^(c?ob|c?fn)=\\((\\d+)\\) ?(.*)$"));
    Profile profile;
    QMap<int, QString> objects;
    bool ours = true, total = false;
    quint64 all = 0, told = 0;
    for (const QString& line : linesOf(QString::fromUtf8(readFile(path)))) {
        if (line.startsWith(QStringLiteral("totals: ")))
            told = line.section(QLatin1Char(' '), 1, 1).toULongLong();
        const QRegularExpressionMatch match = entry.match(line);
        if (match.hasMatch()) {
            const QString kind = match.captured(1), name = match.captured(3);
            const int number = match.captured(2).toInt();
            if (kind.endsWith(QLatin1Char('n')) && !name.isEmpty()) profile.functions.insert(name);
            if (kind.endsWith(QLatin1Char('b')) && !name.isEmpty()) objects[number] = name;
            if (kind == QLatin1StringView("ob")) ours = !objects[number].contains(QStringLiteral("/libc.so"));
        } else if (line.startsWith(QStringLiteral("calls="))) {
            total = true;
        } else if (!line.isEmpty() && (line[0].isDigit() || QStringLiteral("+-*").contains(line[0]))) {
            const quint64 cost =
                std::exchange(total, false) ? 0 : line.section(QLatin1Char(' '), 1, 1).toULongLong();
            all += cost;
            if (ours) profile.instructions += cost;
        }
    }
    if (all != told || all == 0) qFatal("the profile's parts add up to %llu, not %llu", all, told);
    return profile;
}

/// Of all these scenes, in one run of valgrind, which writes a file a scene; empty where it failed.
QMap<QByteArray, Profile> profilesOf(const QList<QByteArray>& texts) {
    const QTemporaryDir folder;
    const QString counts = folder.filePath(QStringLiteral("counts"));
    const test::Ended ended = test::countFrames(texts, framesBefore, framesCounted, counts);
    const QStringList hashes = linesOf(ended.out);
    if (ended.exitCode != 0 || hashes.size() != texts.size()) {
        qWarning("%s", qPrintable(ended.err));
        return {};
    }
    QMap<QByteArray, Profile> profiles;
    for (qsizetype i = 0; i < texts.size(); ++i) {
        Profile& profile = profiles[texts[i]] = readProfile(counts + QStringLiteral(".%1").arg(i + 1));
        profile.hash = hashes[i];
    }
    return profiles;
}

/// Whether a function whose name holds `name` was called.
bool calls(const Profile& profile, const QString& name) {
    return std::any_of(profile.functions.begin(), profile.functions.end(),
                       [&](const QString& function) { return function.contains(name); });
}

/// A floor, a fixed post, balls that bounce and meet, and boxes that rest; `extra` stands in what can move.
QByteArray sceneWith(const char* extra, const char* floor = "", const QByteArray& more = {}) {
    QByteArray text = QByteArray("wall { normal 0, 1, 0  toOrig 0  elastic 0.5 ") + floor + " }\n" +
                      "sphere post { radius 0.1  centre 50, 0, 0  fixed yes }\n" + more;
    for (int i = 0; i < 12; ++i)
        text += "sphere { radius 0.2  mass 1  centre " + QByteArray::number(0.45 * i) + ", " +
                QByteArray::number(0.5 + 0.1 * (i % 5)) + ", 0  vel " + (i % 2 == 0 ? "1" : "-1") +
                ", 0, 0  elastic 0.9 " + extra + " }\n";
    return text;
}

/// Two boxes, one on the other, that slide on the floor or rest on it.
const char* const boxes = "cuboid a { size 1, 1, 1  mass 1  centre 9, 0.5, 0  vel 1, 0, 0  elastic 0 }\n"
                          "cuboid b { size 1, 1, 1  mass 1  centre 9, 1.5, 0  vel 1, 0, 0  elastic 0 }\n";
const char* const boxesAtRest = "cuboid a { size 1, 1, 1  mass 1  centre 9, 0.5, 0  elastic 0 }\n"
                                "cuboid b { size 1, 1, 1  mass 1  centre 9, 1.5, 0  elastic 0 }\n";

/// A ball that rolls on a floor with friction.
QByteArray resisted(const char* arm) {
    return QByteArray("sphere { radius 0.5  mass 1  centre 9, 0.5, 9  vel 1, 0, 0  friction 1  rolling ") +
           arm + " }\ncuboid { size 99, 1, 99  centre 9, -0.5, 9  fixed yes  friction 1 }\n";
}

/// A scene with something that has no effect, or that a kernel is needed for, and the same without.
struct Comparison {
    const char* name;
    const char* kernel; // that the scene with it needs
    QByteArray with, without = sceneWith("");
};

QList<Comparison> rowsOfZeros() {
    QList<Comparison> rows;
    const auto add = [&](const char* name, const QByteArray& with,
                         const QByteArray& without = sceneWith("")) {
        rows.push_back({name, "", with, without});
    };
    add("friction 0", sceneWith("friction 0"));
    add("friction 0 of boxes, too", sceneWith("friction 0", "friction 0", boxesAtRest),
        sceneWith("", "", boxesAtRest));
    add("friction of the floor alone", sceneWith("", "friction 0.5"));
    add("friction of what is fixed",
        sceneWith("", "friction 0.5", "wall { normal 1, 0, 0  toOrig 99  friction 1 }\n"),
        sceneWith("", "", "wall { normal 1, 0, 0  toOrig 99 }\n"));
    add("rolling 0", sceneWith("rolling 0"));
    add("no spin", sceneWith("angvel 0, 0, 0"));
    add("speed of what is fixed",
        sceneWith("", "", "sphere { radius 1  centre 60, 0, 0  fixed yes  vel 1, 2, 3  angvel 1, 2, 3 }\n"),
        sceneWith("", "", "sphere { radius 1  centre 60, 0, 0  fixed yes }\n"));
    add("a spring between what is fixed",
        sceneWith("", "", "spring { from world  to post  stiffness 5  damping 1 }\n"));
    add("damping 0",
        sceneWith("", "",
                  "sphere a { radius 0.1  mass 1  centre 9, 9, 9 }\nspring { from world  to a  stiffness "
                  "5  length 1  damping 0 }\n"),
        sceneWith("", "",
                  "sphere a { radius 0.1  mass 1  centre 9, 9, 9 }\nspring { from world  to a  stiffness "
                  "5  length 1 }\n"));
    add("air of density 0", sceneWith("drag 0.5", "", "air { density 0  wind 1, 2, 3 }\n"));
    add("air about what has no drag", sceneWith("drag 0", "", "air { density 1.2  wind 1, 2, 3 }\n"));
    add("drag without air", sceneWith("drag 0.5"));
    add("gravity as it is", sceneWith("", "", "gravity { accel 0, -9.8, 0 }\n"));
    return rows;
}

QList<Comparison> rowsOfKernels() {
    QList<Comparison> rows;
    const auto add = [&](const char* name, const char* kernel, const QByteArray& with,
                         const QByteArray& without = sceneWith("")) {
        rows.push_back({name, kernel, with, without});
    };
    const QByteArray rough = sceneWith("friction 0.3", "friction 0.3");
    const QByteArray tied = "sphere a { radius 0.1  mass 1  centre 9, 9, 9 }\n"
                            "spring { from world  to a  stiffness 5  length 1 }\n";
    add("rotation", "carom::rotateAllFreely(", rough);
    add("gyroscopic term", "::rotateAsymmetric(",
        sceneWith("", "", "cuboid { size 1, 2, 3  mass 1  centre 9, 99, 9  angvel 1, 2, 3 }\n"));
    add("gyroscopic term of a cube", "::rotateAsymmetric(",
        sceneWith("", "", "cuboid { size 1, 2, 3  mass 1  centre 9, 99, 9  angvel 1, 2, 3 }\n"),
        sceneWith("", "", "cuboid { size 2, 2, 2  mass 1  centre 9, 99, 9  angvel 1, 2, 3 }\n"));
    add("friction", "carom::ImpactSolver::solveLone(", rough);
    add("rolling resistance", "carom::rollingVelocity(", resisted("0.01"), resisted("0"));
    add("springs", "carom::springEnergy(", sceneWith("", "", tied));
    add("forces of springs", "carom::SpringSteps::find(", sceneWith("", "", tied));
    add("air", "carom::ForcedSteps::solve(", sceneWith("drag 0.5", "", "air { density 1.2 }\n"));
    add("contacts of cuboids", "carom::collideCuboidCuboid(", sceneWith("", "", boxes));
    const QByteArray alone = "wall { normal 0, 1, 0  toOrig 0  elastic 0.5 }\n";
    add("contact forces", "carom::NewtonSolver::solve(", sceneWith("", "", boxes),
        "sphere { radius 1  mass 1  centre 0, 9, 0 }\n");
    add("contact forces of what rests", "carom::NewtonSolver::solve(", alone + boxes, alone + boxesAtRest);
    add("contacts of what rests", "carom::collideCuboidCuboid(", sceneWith("", "", boxes),
        sceneWith("", "", boxesAtRest));
    add("collision", "carom::collideInto(", sceneWith("", "", boxes),
        "sphere { radius 1  mass 1  centre 0, 9, 0 }\n");
    return rows;
}

} // namespace

class UnusedTest : public QObject {
    Q_OBJECT

    QMap<QByteArray, Profile> m_profiles;

    static void addRows(const QList<Comparison>& rows) {
        QTest::addColumn<QString>("kernel");
        QTest::addColumn<QByteArray>("with");
        QTest::addColumn<QByteArray>("without");
        for (const Comparison& row : rows)
            QTest::newRow(row.name) << QString::fromLatin1(row.kernel) << row.with << row.without;
    }

  private Q_SLOTS:
    void initTestCase() {
        QList<QByteArray> texts = {sceneWith(""), sceneWith("") + "# and a word more\n"};
        for (const Comparison& row : rowsOfZeros() + rowsOfKernels())
            for (const QByteArray& text : {row.with, row.without})
                if (!texts.contains(text)) texts.push_back(text);
        m_profiles = profilesOf(texts);
        QVERIFY2(!m_profiles.isEmpty(), "valgrind is a package that the tests need");
    }

    void theSameSceneTakesTheSameInstructions() {
        const Profile once = m_profiles[sceneWith("")];
        const Profile again = m_profiles[sceneWith("") + "# and a word more\n"];
        QVERIFY(once.instructions > 100'000);
        QCOMPARE(again.instructions, once.instructions);
        QCOMPARE(again.hash, once.hash);
    }

    void anEffectThatIsAbsentTakesNoInstruction_data() { addRows(rowsOfZeros()); }
    void anEffectThatIsAbsentTakesNoInstruction() {
        QFETCH(QByteArray, with);
        QFETCH(QByteArray, without);
        QVERIFY(with != without);
        const Profile a = m_profiles[with], b = m_profiles[without];
        QVERIFY(b.instructions > 100'000);
        QCOMPARE(a.instructions, b.instructions);
        QCOMPARE(a.hash, b.hash);
    }

    void theKernelsOfAnAbsentEffectAreNotCalled_data() { addRows(rowsOfKernels()); }
    void theKernelsOfAnAbsentEffectAreNotCalled() {
        QFETCH(QString, kernel);
        QFETCH(QByteArray, with);
        QFETCH(QByteArray, without);
        QVERIFY2(calls(m_profiles[with], kernel), "the kernel has another name by now");
        QVERIFY(m_profiles[without].instructions > 1000);
        QVERIFY(!calls(m_profiles[without], kernel));
    }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, unused_test, carom::UnusedTest)
#include "unused_test.moc"
