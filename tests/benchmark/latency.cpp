// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/errors.h"
#include "app/files.h"
#include "tests/support/whole_ide.h"

#include "core/base/clock.h"
#include "core/generators/generator.h"
#include "core/math/random.h"
#include "core/math/statistics.h"
#include "ui/widgets/timeline.h"
#include "ui/window/live_preview.h"

#include <QKeyEvent>
#include <QProcess>
#include <QSettings>
#include <QTimer>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <optional>
#include <thread>
#include <utility>

// carom-latency [typing] [scrub] [edit] [pictures] [load] [start]: what a user waits for, in the whole IDE on
// the display it is started on. All of it without an argument. Not a test: the figures are of the machine,
// which should have nothing else to do.

namespace carom {
namespace {

using namespace test;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t seed = 33;
constexpr std::int64_t runFrames = 180; // 3 s

double millisecondsSince(Clock::time_point start, Clock::time_point end = Clock::now()) {
    return std::chrono::duration<double, std::milli>(end - start).count();
}

QByteArray generated(const char* generator, std::int64_t bodies, const char* more = "") {
    GeneratorRequest request;
    request.n = bodies;
    return QByteArray::fromStdString(generate(*findGenerator(generator), request)) + more;
}

void tell(const std::string& what, const std::vector<double>& times) {
    const Summary summary = summarise(times);
    std::printf("%-60s %5zu %9.1f %9.1f %9.1f\n", what.c_str(), times.size(), summary.median, summary.p95,
                summary.maximum);
}

/// Sleeps between events instead of looking for them without end: the simulation needs the processors.
template<class Condition>
bool waitFor(const Condition& condition) {
    constexpr int heartbeat = 100; // [ms] at which a wait for what never comes looks at the clock
    QTimer beat;
    beat.start(heartbeat);
    const Clock::time_point start = Clock::now();
    while (!condition() && millisecondsSince(start) < longestWait)
        QApplication::processEvents(QEventLoop::AllEvents | QEventLoop::WaitForMoreEvents);
    return condition();
}

/// Knows when a picture of a widget is on screen. Qt draws all widgets of a window that need it and hands the
/// window to the display within one event; what was queued during it runs after it.
class Screen : public QObject {
  public:
    /// From now on: nothing was shown yet.
    void forget() {
        m_shown.reset();
        ++m_round;
    }
    bool hasShown() const { return m_shown.has_value(); }
    Clock::time_point shownAt() const { return *m_shown; }

    void watch(QWidget& widget) { widget.installEventFilter(this); }

  protected:
    bool eventFilter(QObject* object, QEvent* event) override {
        if (event->type() == QEvent::Paint) noteDrawn();
        return QObject::eventFilter(object, event);
    }

  private:
    void noteDrawn() {
        QMetaObject::invokeMethod(
            this,
            [this, round = m_round] {
                if (!m_shown && round == m_round) m_shown = Clock::now();
            },
            Qt::QueuedConnection);
    }

    std::optional<Clock::time_point> m_shown;
    int m_round = 0; ///< what was drawn before forget() does not count
};

class Latency {
  public:
    void typing();
    void scrub();
    void edit();
    void pictures();
    void load();
    void start();

  private:
    void typeInto(Ide& ide, const std::string& what);
    void scrubThrough(Ide& ide, const std::string& what);
    void exchangeAt3Seconds(const QByteArray& text, const std::string& what);
    void watchPlay(const QByteArray& text, const std::string& what);
};

/// Keys come from a thread of their own at random times, as they do from the window system: also while the
/// GUI's is drawing.
void Latency::typeInto(Ide& ide, const std::string& what) {
    constexpr int keys = 60;
    ide.editor.send(QsciScintillaBase::SCI_GOTOPOS, 0);
    ide.editor.setFocus();
    Screen screen;
    screen.watch(*ide.editor.viewport());
    Random random(seed);
    std::vector<double> waits, turns, edits; // a turn: until the GUI thread has time for the key
    for (int i = 0; i < keys; ++i) {
        const std::chrono::duration<double, std::milli> pause(random.uniform(60, 180));
        Clock::time_point pressed;
        bool handled = false;
        std::jthread typist([&] {
            std::this_thread::sleep_for(pause);
            pressed = Clock::now();
            QMetaObject::invokeMethod(
                &ide.editor,
                [&] {
                    const Clock::time_point taken = Clock::now();
                    turns.push_back(millisecondsSince(pressed, taken));
                    screen.forget();
                    handled = true;
                    QTest::keyClick(&ide.editor, i == 0 ? Qt::Key_NumberSign : Qt::Key_A);
                    edits.push_back(millisecondsSince(taken));
                },
                Qt::QueuedConnection);
        });
        if (!waitFor([&] { return handled && screen.hasShown(); })) break;
        waits.push_back(millisecondsSince(pressed, screen.shownAt()));
    }
    tell(what, waits);
    tell("    until its turn", turns);
    tell("    in the text", edits);
}

void Latency::typing() {
    {
        Ide ide(generated("brownian", 500));
        waitFor([&] { return ide.frame == 0; });
        typeInto(ide, "key to screen, 500 bodies, paused");
    }
    for (const std::int64_t bodies : {500, 10000}) {
        Ide ide(generated("brownian", bodies));
        waitFor([&] { return ide.frame == 0; });
        ide.trigger(ActionId::Play);
        waitFor([&] { return ide.frame > 5; });
        const std::int64_t frame = ide.frame;
        const Clock::time_point start = Clock::now();
        typeInto(ide, "key to screen, " + std::to_string(bodies) + " bodies running");
        std::printf("    meanwhile %.1f frames/s simulated\n",
                    static_cast<double>(ide.frame - frame) / millisecondsSince(start) * 1e3);
    }
}

void Latency::scrubThrough(Ide& ide, const std::string& what) {
    Timeline& timeline = ide.bench.window().timeline();
    Screen screen;
    screen.watch(ide.viewport);
    Random random(seed);
    std::vector<double> waits;
    for (int i = 0; i < 60; ++i) {
        const std::int64_t frame = static_cast<std::int64_t>(random.below(runFrames + 1));
        const QPoint place(static_cast<int>(timeline.xOf(frame)), timeline.height() / 2);
        const std::int64_t wanted = timeline.frameAt(place.x());
        if (wanted == ide.frame) continue;
        const Clock::time_point pressed = Clock::now();
        QTest::mouseClick(&timeline, Qt::LeftButton, {}, place);
        if (!waitFor([&] { return ide.frame == wanted; })) break;
        if (!waitFor([&] { return ide.viewport.shownFrame() == wanted; })) break;
        screen.forget(); // the picture is there, and is painted next
        if (!waitFor([&] { return screen.hasShown(); })) break;
        waits.push_back(millisecondsSince(pressed, screen.shownAt()));
    }
    tell(what, waits);
}

void Latency::scrub() {
    for (const std::int64_t bodies : {500, 10000}) {
        Ide ide(generated("brownian", bodies));
        waitFor([&] { return ide.frame == 0; });
        ide.simulation.seek(runFrames);
        waitFor([&] { return ide.frame == runFrames; });
        scrubThrough(ide, "scrub to any frame of 3 s, " + std::to_string(bodies) + " bodies");
    }
}

void Latency::exchangeAt3Seconds(const QByteArray& text, const std::string& what) {
    Ide ide(text);
    waitFor([&] { return ide.frame == 0; });
    ide.simulation.seek(runFrames);
    waitFor([&] { return ide.frame == runFrames; });
    int landed = 0;
    const QMetaObject::Connection connection =
        QObject::connect(&ide.simulation, &Simulation::landed, &ide.bench, [&landed] { ++landed; });
    std::vector<double> waits;
    for (int i = 0; i < 5; ++i) {
        const Clock::time_point edited = Clock::now();
        ide.simulation.exchange(ide.bench.preview().shown()->build.pipeline);
        if (!waitFor([&] { return landed == i + 1; })) break;
        waits.push_back(millisecondsSince(edited));
    }
    QObject::disconnect(connection);
    tell(what, waits);
}

void Latency::edit() {
    for (const char* method : {"contacts", "microcollisions", "events"}) {
        const QByteArray setting = QByteArray("\nsimulation { method ") + method + " }\n";
        exchangeAt3Seconds(generated("brownian", 500, setting),
                           std::string("500 bodies simulated to 3 s, gas, ") + method);
    }
    exchangeAt3Seconds(generated("pile", 500), "500 bodies simulated to 3 s, pile, contacts");
}

void Latency::watchPlay(const QByteArray& text, const std::string& what) {
    Ide ide(text);
    ide.bench.window().resize(1600, 1000);
    ide.trigger(ActionId::WorkspaceWatch);
    waitFor([&] { return ide.frame == 0; });
    std::vector<double> pictures;
    const QMetaObject::Connection drawn =
        QObject::connect(&ide.viewport, &Viewport::frameRendered, &ide.bench,
                         [&pictures](double milliseconds) { pictures.push_back(milliseconds); });
    ide.trigger(ActionId::Play);
    waitFor([&] { return ide.frame > 10; });
    pictures.clear();
    const Clock::time_point start = Clock::now();
    constexpr double watched = 5000; // [ms]
    waitFor([&] { return millisecondsSince(start) > watched; });
    const double seconds = 1e-3 * millisecondsSince(start);
    QObject::disconnect(drawn);
    tell("drawing " + what, pictures);
    std::printf("    %.1f pictures/s of %d x %d pixels\n", static_cast<double>(pictures.size()) / seconds,
                ide.viewport.width(), ide.viewport.height());
}

void Latency::pictures() {
    watchPlay(generated("brownian", 500), "500 bodies running");
    watchPlay(generated("brownian", 10000), "10,000 bodies running");
}

/// Looks every millisecond whether the GUI's thread answers.
class Silences {
  public:
    Silences() {
        QObject::connect(&m_beat, &QTimer::timeout, &m_beat, [this] { look(); });
        m_beat.start(1);
    }
    /// The longest times without an answer, and those in which the thread itself was at work all the while:
    /// a busy machine makes the first longer, not the second.
    void tell(const std::string& what) {
        look();
        carom::tell(what, longest(m_silent));
        carom::tell("    of it at work", longest(m_atWork));
        m_silent.clear();
        m_atWork.clear();
    }

  private:
    void look() {
        m_silent.push_back(m_since.lap());
        m_atWork.push_back(processorTimeOfThread() - std::exchange(m_worked, processorTimeOfThread()));
    }
    static std::vector<double> longest(std::vector<double> times) {
        constexpr std::ptrdiff_t told = 10;
        std::sort(times.begin(), times.end());
        return {times.end() - std::min(told, std::ssize(times)), times.end()};
    }

    QTimer m_beat;
    Stopwatch m_since;
    double m_worked = processorTimeOfThread(); ///< [ms]
    std::vector<double> m_silent, m_atWork;    ///< [ms]
};

/// A text of 200,000 declarations: for how long the window does not answer while it is loaded, and after a
/// letter typed into it.
void Latency::load() {
    constexpr std::size_t declarations = 200000;
    Ide ide;
    const QString path = ide.folder.filePath(QStringLiteral("large.sdl"));
    writeFile(path, generated("brownian", declarations));
    waitFor([&] { return ide.frame == 0; });
    const auto isOnScreen = [&ide] {
        const SharedBuild shown = ide.bench.preview().shown();
        return ide.current() && shown->build.pipeline->scene().bodies.size() >= declarations;
    };
    const auto settle = [&ide] {
        const std::int64_t drawn = ide.viewport.framesRendered();
        waitFor([&] { return ide.viewport.framesRendered() > drawn + 1; });
    };
    Silences silences;
    const Stopwatch begun;
    if (ide.bench.document().open(path)) qFatal("the large scene cannot be opened");
    silences.tell("opening the text, 200,000 declarations: its ten longest silences");
    waitFor(isOnScreen);
    tell("200,000 declarations on screen", {begun.elapsed()});
    settle();
    silences.tell("building and showing them: the ten longest silences");

    ide.editor.send(QsciScintillaBase::SCI_GOTOPOS, 0);
    ide.editor.setFocus();
    Screen screen;
    screen.watch(*ide.editor.viewport());
    const Stopwatch pressed;
    QTest::keyClick(&ide.editor, Qt::Key_NumberSign); // the first line is a comment now
    waitFor([&] { return screen.hasShown(); });
    tell("key to screen in 200,000 declarations", {pressed.elapsed()});
    waitFor(isOnScreen);
    settle();
    silences.tell("after it, until its scene is shown: the ten longest silences");

    screen.forget();
    const Stopwatch gone;
    ide.editor.send(QsciScintillaBase::SCI_DOCUMENTEND);
    waitFor([&] { return screen.hasShown(); });
    tell("to the end of 200,000 declarations", {gone.elapsed()});
    silences.tell("    its ten longest silences");
}

/// The program from its first instruction to its end after one picture: the window is there, has drawn the
/// scene and has taken events in between. The first start warms the caches.
void Latency::start() {
    constexpr int starts = 10;
    for (const char* scene : {"pool_break", "stone_wall"}) {
        std::vector<double> times;
        for (int i = 0; i <= starts; ++i) {
            const Clock::time_point begun = Clock::now();
            const int left = QProcess::execute(
                QStringLiteral(CAROM_PROGRAM),
                {QStringLiteral(CAROM_SOURCE_DIR "/scenes/%1.sdl").arg(QLatin1StringView(scene)),
                 QStringLiteral("-n"), QStringLiteral("1")});
            if (left != 0) qFatal("the program did not start");
            if (i > 0) times.push_back(millisecondsSince(begun));
        }
        tell(std::string("start to picture and end, ") + scene, times);
    }
}

int measure(const QStringList& wanted) {
    using Section = std::pair<const char*, void (Latency::*)()>;
    constexpr std::array sections = {
        Section{"typing", &Latency::typing}, Section{"scrub", &Latency::scrub},
        Section{"edit", &Latency::edit},     Section{"pictures", &Latency::pictures},
        Section{"load", &Latency::load},     Section{"start", &Latency::start}};
    for (const QString& word : wanted)
        if (std::none_of(sections.begin(), sections.end(),
                         [&](const Section& section) { return word == QLatin1StringView(section.first); })) {
            printError("carom-latency: `" + word.toStdString() +
                       "` is none of typing, scrub, edit, pictures, load, start\n");
            return exitcode::wrongUsage;
        }
    std::printf("%-60s %5s %9s %9s %9s\n", "[ms]", "of", "median", "p95", "max");
    Latency latency;
    for (const auto& [name, run] : sections) {
        if (!wanted.isEmpty() && !wanted.contains(QLatin1StringView(name))) continue;
        QSettings().clear();
        (latency.*run)();
        std::fflush(stdout);
    }
    return 0;
}

} // namespace
} // namespace carom

int main(int argc, char** argv) {
    const carom::test::IdeApplication application(argc, argv);
    return carom::measure(QCoreApplication::arguments().mid(1));
}
