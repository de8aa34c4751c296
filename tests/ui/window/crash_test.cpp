// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/process_figures.h"
#include "tests/support/program.h"
#include "tests/support/test_class.h"

#include "ui/window/recovery.h"

#include <QDir>
#include <QElapsedTimer>
#include <QFile>
#include <QProcess>
#include <QRandomGenerator>
#include <QTest>
#include <QThread>

#include <functional>
#include <memory>

using namespace carom;
using namespace carom::test;

// The built program under a real X server, typed into by synthetic keys, and killed (SIGKILL) in the middle
// of it. Whatever was typed longer ago than the swap file may be behind must be found again.

namespace {

constexpr quint32 seed = 4711;    // of the moments of the kills
constexpr int behind = 200;       // [ms] the swap file may be, by the settings of these sessions
constexpr int intoTheFrame = 300; // [ms] of processor time
constexpr int mostTurns = 1000;   // until one is killed in time
const QByteArray original = "// a scene\n";

int kills() { return roundsOf("CAROM_KILLS", 2); }

QByteArray xdotool(const QStringList& arguments) {
    QProcess process;
    process.start(QStringLiteral("xdotool"), arguments);
    if (!process.waitForFinished(longestWait)) return {};
    return process.readAllStandardOutput().trimmed();
}

/// A running program with a home of its own.
class Session {
  public:
    Session(const QString& home, const QString& scene, const QStringList& options = {}) {
        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        environment.insert(QStringLiteral("XDG_CONFIG_HOME"), home);
        environment.insert(QStringLiteral("XDG_DATA_HOME"), home);
        environment.insert(QStringLiteral("XDG_RUNTIME_DIR"), home);
        m_process.setProcessEnvironment(environment);
        m_process.setProcessChannelMode(QProcess::ForwardedErrorChannel);
        m_process.start(QStringLiteral(CAROM_PROGRAM),
                        options + (scene.isEmpty() ? QStringList() : QStringList{scene}));
    }
    ~Session() { kill(); }

    /// Waits for a window with that title and gives it the keyboard.
    bool focus(const QString& title) {
        QByteArray id;
        if (!becomes([&] { return !(id = windowOf(title)).isEmpty(); })) return false;
        xdotool({QStringLiteral("windowfocus"), QStringLiteral("--sync"), QString::fromLatin1(id)});
        return true;
    }
    /// Waits until no window has that title.
    bool loses(const QString& title) {
        return becomes([&] { return windowOf(title).isEmpty(); });
    }
    void type(const QByteArray& text) {
        xdotool({QStringLiteral("type"), QStringLiteral("--delay"), QStringLiteral("8"),
                 QString::fromLatin1(text)});
    }
    void press(const char* key) { xdotool({QStringLiteral("key"), QString::fromLatin1(key)}); }
    qint64 number() const { return m_process.processId(); }
    bool hasEnded() { return m_process.state() == QProcess::NotRunning || m_process.waitForFinished(100); }
    int exitCode() const {
        return m_process.exitStatus() == QProcess::NormalExit ? m_process.exitCode() : -1;
    }
    void kill() {
        if (m_process.state() == QProcess::NotRunning) return;
        m_process.kill(); // SIGKILL: no handler runs, nothing is written any more
        m_process.waitForFinished(longestWait);
    }

  private:
    static QByteArray windowOf(const QString& title) {
        return xdotool({QStringLiteral("search"), QStringLiteral("--onlyvisible"), QStringLiteral("--name"),
                        title})
            .split('\n')
            .value(0);
    }
    bool becomes(const std::function<bool()>& holds) {
        QElapsedTimer clock;
        clock.start();
        while (clock.elapsed() < longestWait && m_process.state() != QProcess::NotRunning) {
            m_process.waitForFinished(50); // looking takes half of that; sees an early end, too
            if (holds()) return true;
        }
        return false;
    }

    QProcess m_process;
};

struct Desk {
    QTemporaryDir home;
    QString scene = home.filePath(QStringLiteral("scene.sdl"));
    QString swaps = home.filePath(QStringLiteral("carom/carom/recovery"));

    Desk() {
        writeFile(scene, original);
        const QString settings = home.filePath(QStringLiteral("carom"));
        if (!QDir().mkpath(settings)) qFatal("cannot make %s", qPrintable(settings));
        writeFile(settings + QStringLiteral("/carom.conf"),
                  "[recovery]\ninterval=" + QByteArray::number(behind) + "\n");
    }
    /// The content of the one swap file; nothing where there is none.
    QByteArray swapFile() const {
        const QStringList files = QDir(swaps).entryList({QStringLiteral("*.swap")});
        return files.size() == 1 ? readFile(swaps + u'/' + files.front()) : QByteArray();
    }
    QByteArray lost() const {
        const std::vector<LostText> texts = Recovery::lostTexts(swaps).texts;
        return texts.empty() ? QByteArray() : texts.front().text;
    }
};

} // namespace

class CrashTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void whatWasTypedBeforeAKillIsOfferedAtTheNextStart() {
        Desk desk;
        const QByteArray typed = "// typed and never saved";
        {
            Session session(desk.home.path(), desk.scene);
            QVERIFY(session.focus(QStringLiteral("scene.sdl")));
            session.press("ctrl+End");
            session.type(typed);
            QTRY_VERIFY_WITH_TIMEOUT(desk.swapFile().contains(typed), longestWait);
            session.kill();
        }
        QCOMPARE(readFile(desk.scene), original);
        QCOMPARE(desk.lost(), original + typed);

        Session next(desk.home.path(), desk.scene);
        QVERIFY(next.focus(QStringLiteral("Unsaved text found")));
        next.press("Return"); // recovers it
        QVERIFY(next.loses(QStringLiteral("Unsaved text found")));
        QTRY_VERIFY_WITH_TIMEOUT(!desk.swapFile().isEmpty(), longestWait);
        QVERIFY(next.focus(QStringLiteral("scene.sdl")));
        next.press("ctrl+s");
        QTRY_COMPARE_WITH_TIMEOUT(readFile(desk.scene), original + typed, longestWait);
    }

    void twoWindowsNeverOfferTheSameText() {
        const QString offer = QStringLiteral("Unsaved text found"), scene = QStringLiteral("scene.sdl");
        Desk desk;
        const QByteArray typed = "// typed and never saved";
        {
            Session session(desk.home.path(), desk.scene);
            QVERIFY(session.focus(scene));
            session.press("ctrl+End");
            session.type(typed);
            QTRY_VERIFY_WITH_TIMEOUT(desk.swapFile().contains(typed), longestWait);
        }
        Session first(desk.home.path(), desk.scene);
        QVERIFY(first.focus(offer));
        {
            // It would ask as soon as its window is there; it can be typed into at once.
            const QString other = desk.home.filePath(QStringLiteral("other.sdl"));
            writeFile(other, original);
            Session second(desk.home.path(), other);
            QVERIFY(second.focus(QStringLiteral("other.sdl")));
            second.press("ctrl+End");
            second.type("// other");
            second.press("ctrl+s");
            QTRY_COMPARE_WITH_TIMEOUT(readFile(other), original + "// other", longestWait);
            QTRY_VERIFY_WITH_TIMEOUT(!desk.swapFile().isEmpty(), longestWait); // of the first only
        }
        // Asked later, the first window gives the text back, and the next one offers it.
        QVERIFY(first.focus(offer));
        first.press("Escape");
        QVERIFY(first.loses(offer));
        QCOMPARE(desk.lost(), original + typed);
        Session third(desk.home.path(), desk.scene);
        QVERIFY(third.focus(offer));
    }

    void aKillWhileSavingLeavesAWholeFileAndNothingTypedIsLost() {
        QRandomGenerator random(seed);
        Desk desk;
        for (int turn = 0; turn < kills(); ++turn) {
            const QByteArray before = readFile(desk.scene);
            QByteArray typed;
            qsizetype seen = 0; // of `typed`: on the disk while the program still ran
            {
                Session session(desk.home.path(), desk.scene);
                QVERIFY(session.focus(QStringLiteral("scene.sdl")));
                session.press("ctrl+End");
                QElapsedTimer clock;
                clock.start();
                // How long the program takes for what is typed is the machine's matter; what was on the disk
                // once must never be lost. The first turn waits for that.
                const auto look = [&] {
                    const QByteArray file = readFile(desk.scene), swap = desk.swapFile();
                    for (qsizetype size = typed.size(); size > seen; --size) {
                        const QByteArray text = before + typed.left(size);
                        if (file == text || swap.contains(text)) seen = size;
                    }
                };
                const qint64 end = 300 + random.bounded(700);
                while (clock.elapsed() < end || (turn == 0 && seen == 0 && clock.elapsed() < longestWait)) {
                    const QByteArray word = QByteArray::number(random.bounded(1000000));
                    session.type("# " + word);
                    typed += "# " + word;
                    session.press("ctrl+s");
                    look();
                }
                // A save under way: keys are sent, and the kill follows before they can have been served.
                session.press("ctrl+s");
                session.kill();
                QVERIFY(turn > 0 || seen > 0);
            }
            const QByteArray onDisk = readFile(desk.scene);
            QVERIFY2(onDisk.startsWith(before) && (before + typed).startsWith(onDisk),
                     onDisk.constData()); // a whole version, never half of one
            const QByteArray best =
                std::max(onDisk, desk.lost(),
                         [](const QByteArray& a, const QByteArray& b) { return a.size() < b.size(); });
            QVERIFY2(best.startsWith(before + typed.left(seen)), best.constData());
            for (const LostText& lost : Recovery::lostTexts(desk.swaps).texts) Recovery::discard(lost);
        }
        qInfo("%d were killed", kills());
    }

    void closingDoesNotWaitForTheFrameThatIsSimulated() {
        // Its first frame takes many minutes: a million times a wall of stones.
        Desk desk;
        const QStringList words{QStringLiteral("generate"), QStringLiteral("stone_wall")};
        QByteArray text = runCommand(QStringLiteral(CAROM_PROGRAM), words).out.toUtf8();
        QVERIFY(!text.contains("simulation"));
        writeFile(desk.scene, text + "simulation { substeps 1000000 }\n");
        Session session(desk.home.path(), desk.scene, {QStringLiteral("--play")});
        QVERIFY(session.focus(QStringLiteral("scene.sdl")));
        QTRY_VERIFY_WITH_TIMEOUT(processorTimeOf(session.number(), "simulation") > intoTheFrame, longestWait);
        session.press("ctrl+q");
        QTRY_VERIFY_WITH_TIMEOUT(session.hasEnded(), longestWait);
        QCOMPARE(session.exitCode(), 0);
        QVERIFY(desk.swapFile().isEmpty());
    }

    void aKillWhileAPictureIsExportedLeavesTheOldOneOrTheWhole() {
        const QTemporaryDir folder;
        const QString picture = folder.filePath(QStringLiteral("picture.png"));
        const QStringList words{QStringLiteral(CAROM_SOURCE_DIR "/scenes/pool_break.sdl"),
                                QStringLiteral("--picture"), picture};
        QCOMPARE(runCommand(QStringLiteral(CAROM_PROGRAM), words).exitCode, 0);
        const QByteArray whole = readFile(picture);
        QRandomGenerator random(seed);
        int killed = 0, replaced = 0;
        for (int turn = 0; turn < kills() || (killed == 0 && turn < mostTurns); ++turn) {
            writeFile(picture, "old");
            QProcess process;
            process.setStandardErrorFile(QProcess::nullDevice());
            process.start(QStringLiteral(CAROM_PROGRAM), words);
            // The new file grows beside the old one: within two milliseconds of its appearance.
            const auto isBeingWritten = [&folder] {
                return QDir(folder.path()).entryList(QDir::Files | QDir::Hidden).size() > 1;
            };
            while (!isBeingWritten() && process.state() != QProcess::NotRunning) process.waitForFinished(1);
            QThread::usleep(random.bounded(2000));
            process.kill();
            process.waitForFinished(longestWait);
            killed += process.exitStatus() == QProcess::CrashExit ? 1 : 0;
            const QByteArray found = readFile(picture);
            QVERIFY2(found == "old" || found == whole, qPrintable(QStringLiteral("turn %1").arg(turn)));
            replaced += found == whole ? 1 : 0;
            for (const QString& half : QDir(folder.path()).entryList(QDir::Files | QDir::Hidden))
                if (half != QStringLiteral("picture.png")) QVERIFY(QFile::remove(folder.filePath(half)));
        }
        qInfo("%d of %d were killed; %d had replaced the picture", killed, kills(), replaced);
        QVERIFY(killed > 0);
    }
};

CAROM_TEST_WITH(QCoreApplication, crash_test, CrashTest)
#include "crash_test.moc"
