// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/race_dock.h"

#include "core/integrators/integrator.h"
#include "core/scene/schema.h"
#include "core/simulation/build.h"
#include "ui/base/file_output.h"
#include "ui/base/plain_words.h"
#include "ui/base/theme.h"
#include "ui/viewport/viewport.h"
#include "ui/widgets/empty_state.h"
#include "ui/base/export_menu.h"
#include "ui/widgets/panel_parts.h"
#include "ui/widgets/text_of.h"

#include <QComboBox>
#include <QCoreApplication>
#include <QDoubleSpinBox>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QSlider>
#include <QSpinBox>
#include <QSplitter>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

constexpr int tick = 25; ///< [ms] between two updates while a race runs; at ten times motion is in steps
/// [ms] between two charts of it; at a tenth drawing takes time from the race.
constexpr double chartInterval = 400;
constexpr int mostSubsteps = 10'000;           ///< that the form offers
constexpr std::int64_t mostFrames = 5'000'000; ///< of a race; their distances take 200 MB, at twice 400

/// A choice of words, the first of which leaves it to the text.
QComboBox* choice(const QString& name, const QString& what, const QString& ofText,
                  std::span<const std::string_view> words) {
    QComboBox* box = new QComboBox;
    box->setObjectName(name);
    box->setAccessibleName(what);
    box->setToolTip(what);
    box->addItem(ofText, QString());
    for (const std::string_view word : words) box->addItem(textOf(word), textOf(word));
    return box;
}

/// What core calls the parts of a state.
[[maybe_unused]] constexpr const char* wordsOfCore[] = {
    QT_TRANSLATE_NOOP("carom::Race", "position"),
    QT_TRANSLATE_NOOP("carom::Race", "orientation"),
    QT_TRANSLATE_NOOP("carom::Race", "velocity"),
    QT_TRANSLATE_NOOP("carom::Race", "angular velocity"),
};

/// What a run is made with; beside `other` only what is not the same, as far as anything is not.
QString settingWords(const RunSettings& settings, const RunSettings* other) {
    QStringList all, different;
    const auto add = [&](const QString& words, bool same) {
        all += words;
        if (!same) different += words;
    };
    add(RaceDock::tr("preset %1").arg(textOf(settings.preset->name)),
        other != nullptr && other->preset == settings.preset);
    add(RaceDock::tr("method %1").arg(textOf(settings.method->name)),
        other != nullptr && other->method == settings.method);
    add(RaceDock::tr("integrator %1").arg(textOf(settings.integrator->name)),
        other != nullptr && other->integrator == settings.integrator);
    add(RaceDock::tr("%1 substeps a frame").arg(settings.substeps),
        other != nullptr && other->substeps == settings.substeps);
    return (different.isEmpty() ? all : different).join(QStringLiteral(", "));
}

std::optional<std::string> chosen(const QComboBox& box) {
    const QString word = box.currentData().toString();
    return word.isEmpty() ? std::nullopt : std::optional(word.toStdString());
}

} // namespace

RaceDock::RaceDock(QWidget* parent)
    : Panel(tr("Race"), parent), m_start(new QPushButton), m_duration(new QDoubleSpinBox),
      m_other(wordButton("raceOther", tr("Same text"), tr("Which text the second run is of"))),
      m_state(new QLabel), m_first(new QPushButton), m_export(makeExportMenu(QStringLiteral("race"))),
      m_play(wordButton("racePlay", tr("Play"), tr("Play both runs in real time"))),
      m_slider(new QSlider(Qt::Horizontal)), m_sides{makeSide(QStringLiteral("A"), QStringLiteral("A")),
                                                     makeSide(QStringLiteral("B"), QStringLiteral("B"))},
      m_plot(new PlotWidget) {
    setObjectName(QStringLiteral("race"));
    m_empty =
        new EmptyState(makeBoth(), tr("A race runs the scene twice, with two settings or two texts, and "
                                      "shows how the runs part.\nChoose what differs and then Race; the "
                                      "simulation above goes on meanwhile."));
    QWidget* content = new QWidget;
    QVBoxLayout* column = new QVBoxLayout(content);
    column->setContentsMargins(6, 4, 6, 6);
    column->addWidget(makeTop());
    column->addWidget(m_empty, 1);
    setWidget(content);
    setFocusProxy(m_start);
    connectControls();
    updateControls();
}

RaceDock::~RaceDock() = default;

RaceDock::Side RaceDock::makeSide(const QString& name, const QString& suffix) {
    Side side{
        choice(QStringLiteral("racePreset") + suffix, tr("Preset"), tr("Preset of the text"), presetWords()),
        choice(QStringLiteral("raceMethod") + suffix, tr("Method"), tr("Method of the text"), methodWords()),
        choice(QStringLiteral("raceIntegrator") + suffix, tr("Integrator"), tr("Integrator of the text"),
               integratorWords()),
        new QSpinBox, new QLabel(name)};
    side.title->setTextFormat(Qt::PlainText);                                // names of files
    side.title->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred); // as much as fits
    side.substeps->setObjectName(QStringLiteral("raceSubsteps") + suffix);
    side.substeps->setAccessibleName(tr("Substeps"));
    side.substeps->setToolTip(tr("Substeps a frame"));
    side.substeps->setRange(0, mostSubsteps);
    side.substeps->setSpecialValueText(tr("Substeps of the text"));
    side.substeps->setSuffix(tr(" substeps"));
    side.title->setObjectName(QStringLiteral("raceTitle") + suffix);
    side.title->setTextInteractionFlags(Qt::TextSelectableByMouse);
    return side;
}

QWidget* RaceDock::makeTop() {
    m_start->setObjectName(QStringLiteral("raceStart"));
    m_duration->setObjectName(QStringLiteral("raceDuration"));
    m_duration->setAccessibleName(tr("Simulated time"));
    m_duration->setToolTip(tr("How long both runs last"));
    m_duration->setRange(0.05, 1000);
    m_duration->setSuffix(tr(" s"));
    m_duration->setValue(10);
    m_state->setObjectName(QStringLiteral("raceState"));
    m_state->setTextFormat(Qt::PlainText); // names of files, too
    m_state->setProperty("role", QStringLiteral("muted"));
    m_state->setWordWrap(true);
    m_first->setObjectName(QStringLiteral("raceFirst"));
    m_first->setFlat(true);
    m_first->setToolTip(tr("Show the first frame in which a bit differs"));

    QMenu* texts = new QMenu(m_other);
    texts->addAction(tr("The same text"), this, [this] { setOtherText({}, {}); });
    texts->addAction(tr("The text as it is now"), this, [this] {
        if (m_build)
            setOtherText(QString::fromStdString(m_build->build.analysis.text), tr("%1 before").arg(m_name));
    });
    texts->addAction(tr("A file…"), this, &RaceDock::askForOtherFile);
    m_other->setMenu(texts);
    m_other->setPopupMode(QToolButton::InstantPopup);

    QWidget* top = new QWidget;
    QVBoxLayout* rows = new QVBoxLayout(top);
    rows->setContentsMargins(0, 0, 0, 0);
    QHBoxLayout* run = new QHBoxLayout;
    QLabel* over = new QLabel(tr("over"));
    over->setProperty("role", QStringLiteral("muted"));
    for (QWidget* widget : std::initializer_list<QWidget*>{m_start, over, m_duration, m_first})
        run->addWidget(widget);
    run->addWidget(m_state, 1);
    run->addWidget(m_export);
    rows->addLayout(run);
    QGridLayout* sides = new QGridLayout;
    int row = 0;
    for (const Side& side : m_sides) {
        int place = 0;
        for (QWidget* widget : std::initializer_list<QWidget*>{new QLabel(side.title->text()), side.preset,
                                                               side.method, side.integrator, side.substeps})
            sides->addWidget(widget, row, place++);
        ++row;
    }
    constexpr int behind = 5;
    sides->addWidget(m_other, 1, behind);
    sides->setColumnStretch(behind + 1, 1);
    rows->addLayout(sides);
    return top;
}

void RaceDock::makeViews() {
    if (m_views[0] != nullptr) return;
    for (std::size_t i = 0; i < m_views.size(); ++i) {
        m_views[i] = new Viewport;
        m_views[i]->setMinimumSize(120, 90);
        m_views[i]->setDarkTheme(m_dark);
        m_places[i]->addWidget(m_views[i], 1);
        // One camera: whichever is moved, the other follows.
        connect(m_views[i], &Viewport::cameraMoved, this, [this, i] {
            if (m_linking) return;
            m_linking = true;
            m_views[1 - i]->setCamera(m_views[i]->camera());
            m_linking = false;
        });
    }
}

QWidget* RaceDock::makeBoth() {
    QSplitter* beside = new QSplitter;
    for (std::size_t i = 0; i < m_places.size(); ++i) {
        QWidget* one = new QWidget;
        m_places[i] = new QVBoxLayout(one);
        m_places[i]->setContentsMargins(0, 0, 0, 0);
        m_places[i]->addWidget(m_sides[i].title);
        beside->addWidget(one);
    }
    beside->addWidget(m_plot);
    beside->setChildrenCollapsible(false);
    beside->setSizes({1000, 1000, 1000});
    m_slider->setObjectName(QStringLiteral("raceSlider"));
    m_slider->setAccessibleName(tr("Frame"));
    QWidget* all = new QWidget;
    QVBoxLayout* column = new QVBoxLayout(all);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(beside, 1);
    QHBoxLayout* time = new QHBoxLayout;
    time->addWidget(m_play);
    time->addWidget(m_slider, 1);
    column->addLayout(time);
    return all;
}

void RaceDock::connectControls() {
    m_play->setCheckable(true);
    m_clock.setInterval(tick);
    connect(m_start, &QPushButton::clicked, this, &RaceDock::startOrStop);
    connect(m_play, &QToolButton::toggled, this, &RaceDock::play);
    connect(&m_clock, &QTimer::timeout, this, &RaceDock::follow);
    connect(m_slider, &QSlider::valueChanged, this, [this](int frame) {
        if (frame == m_frame) return;
        m_play->setChecked(false);
        showFrame(frame);
    });
    connect(m_plot, &PlotWidget::placeClicked, this, [this](double time) {
        if (!m_raced[0]) return;
        m_play->setChecked(false);
        showFrame(std::llround(time / m_raced[0]->settings().step));
    });
    connect(m_first, &QPushButton::clicked, this, [this] {
        const std::optional<BitDifference> first = m_recording->firstDifference();
        if (!first) return;
        m_play->setChecked(false);
        showFrame(first->frame);
    });
    connect(&m_runner, &StudyRunner::failed, this, &RaceDock::refuse);
}

void RaceDock::setTheme(const Theme& theme) {
    m_dark = theme.dark;
    for (Viewport* view : m_views)
        if (view != nullptr) view->setDarkTheme(m_dark);
    if (m_recording) showPoints();
}

void RaceDock::setScene(const SharedBuild& build, const QString& name) {
    m_build = build;
    m_name = name;
    updateControls();
}

void RaceDock::setOtherText(const QString& text, const QString& name) {
    m_otherText = text;
    m_otherName = name;
    m_other->setText(text.isEmpty() ? tr("Same text") : plainTitle(name));
}

void RaceDock::askForOtherFile() {
    const QString path =
        QFileDialog::getOpenFileName(this, tr("The other text"), {}, tr("Scenes (*.sdl);;All files (*)"));
    if (path.isEmpty()) return;
    QFile file(path);
    if (file.open(QIODevice::ReadOnly))
        setOtherText(QString::fromUtf8(file.readAll()), QFileInfo(path).fileName());
    else
        Q_EMIT reported(tr("%1 cannot be read: %2").arg(path, file.errorString()));
}

SimulationSettings RaceDock::settingsOf(const Side& side) const {
    SimulationSettings settings;
    settings.preset = chosen(*side.preset);
    settings.method = chosen(*side.method);
    settings.integrator = chosen(*side.integrator);
    if (side.substeps->value() > 0) settings.substeps = side.substeps->value();
    return settings;
}

void RaceDock::updateControls() {
    const bool moves = m_build && !m_build->build.pipeline->bodies().mobileBodies.empty();
    m_start->setText(m_runner.isRunning() ? tr("Stop") : tr("Race"));
    m_start->setEnabled(m_runner.isRunning() || moves);
    m_start->setToolTip(m_runner.isRunning() ? tr("Keep what was computed so far")
                        : moves              ? tr("Run the scene both ways")
                                             : tr("Nothing in the scene can move"));
    m_empty->setEmpty(m_recording == nullptr);
    m_play->setEnabled(m_recording != nullptr);
    m_export->setVisible(m_recording != nullptr);
    m_first->setVisible(m_recording != nullptr);
}

void RaceDock::startOrStop() {
    if (m_runner.isRunning()) {
        m_runner.stop();
        return;
    }
    Plan plan{.build = m_build,
              .otherText = m_otherText.toStdString(),
              .settings = {settingsOf(m_sides[0]), settingsOf(m_sides[1])},
              .names = {m_name, m_otherText.isEmpty() ? m_name : m_otherName},
              .duration = m_duration->value()};
    m_runner.start([this, plan = std::move(plan)](const std::stop_token& stop) { return run(stop, plan); });
    m_state->setText(tr("computing"));
    updateControls();
}

// On the thread: the recording is the only thing it shares with the GUI's.
StudyRunner::Finish RaceDock::run(const std::stop_token& stop, const Plan& plan) {
    const Scene& scene = plan.build->scene();
    Contest contest;
    contest.names = plan.names;
    for (std::size_t i = 0; i < contest.runs.size(); ++i)
        contest.runs[i] = std::make_shared<const Pipeline>(scene, plan.settings[i]);
    if (!plan.otherText.empty()) {
        const std::optional<Build> other =
            buildWhile([&stop](double) { return !stop.stop_requested(); }, plan.otherText, plan.settings[1]);
        if (!other) return [this] { refuse(tr("Stopped")); };
        contest.runs[1] = other->pipeline;
    }
    if (const std::optional<std::string> objection = objectionToRace(*contest.runs[0], *contest.runs[1]))
        return [this, objection] { refuse(QString::fromStdString(*objection)); };
    const std::shared_ptr<RaceRecording> recording = std::make_shared<RaceRecording>();
    contest.recording = recording;
    Race race(contest.runs[0], contest.runs[1]);
    recording->add(race);
    contest.frames = std::clamp<std::int64_t>(std::llround(plan.duration / contest.runs[0]->settings().step),
                                              1, mostFrames);
    QMetaObject::invokeMethod(
        this, [this, contest] { begin(contest); }, Qt::QueuedConnection);
    while (race.now().frame < contest.frames && !stop.stop_requested() && race.step()) recording->add(race);
    return [this] { finish(); };
}

void RaceDock::refuse(const QString& sentence) {
    updateControls();
    m_state->setText(sentence);
    Q_EMIT reported(sentence);
}

/// Both runs are there, at their start; what follows is played as it comes.
void RaceDock::begin(const Contest& contest) {
    makeViews();
    m_raced = contest.runs;
    m_recording = contest.recording;
    m_times.clear();
    m_distances.clear();
    m_frame = 0;
    m_time = 0;
    updateControls();
    m_slider->setRange(0, static_cast<int>(contest.frames));
    m_slider->setValue(0);
    for (std::size_t i = 0; i < m_views.size(); ++i) {
        m_views[i]->showPipeline(m_raced[i]);
        const RunSettings &settings = m_raced[i]->settings(), &others = m_raced[1 - i]->settings();
        const QString pattern = QStringLiteral("%1: %2, %3");
        const QChar letter(u'A' + static_cast<char16_t>(i));
        m_sides[i].title->setText(
            pattern.arg(QString(letter), contest.names[i], settingWords(settings, &others)));
        m_sides[i].title->setToolTip(
            plainTip(pattern.arg(QString(letter), contest.names[i], settingWords(settings, nullptr))));
    }
    // When the views have their size, by which a scene without a camera is framed.
    QTimer::singleShot(0, this, [this] { m_views[1]->setCamera(m_views[0]->camera()); });
    showPoints();
    m_play->setChecked(true);
    m_sinceTick.lap();
    m_clock.start();
}

void RaceDock::finish() {
    updateControls();
    showPoints();
    const std::int64_t frames = m_recording->count() - 1;
    m_slider->setMaximum(static_cast<int>(frames));
    const double apart = m_recording->pointsFrom(frames).front().apart.distance;
    m_state->setText(tr("%1 m apart after %2 frames").arg(QString::number(apart, 'g', 3)).arg(frames));
    Q_EMIT reported(tr("race of %1: %2; %3").arg(m_sides[0].title->text(), m_state->text(), m_first->text()));
}

void RaceDock::play(bool plays) {
    if (!m_recording) return;
    if (plays && m_frame + 1 >= m_recording->count() && !m_runner.isRunning()) showFrame(0); // once more
    m_sinceTick.lap();
    if (plays) m_clock.start();
}

/// What is played goes on in real time, as far as it is computed.
void RaceDock::follow() {
    const double elapsed = 1e-3 * m_sinceTick.elapsed();
    m_sinceTick.lap();
    if (m_runner.isRunning() && m_sinceChart.elapsed() > chartInterval) showPoints();
    const std::int64_t last = m_recording->count() - 1;
    if (m_play->isChecked() && last >= 0) {
        const double step = m_raced[0]->settings().step;
        m_time = std::min(m_time + elapsed, static_cast<double>(last) * step);
        const double time = m_time;
        showFrame(std::llround(m_time / step));
        m_time = time;
        if (m_frame >= last && !m_runner.isRunning()) m_play->setChecked(false);
    }
    if (!m_play->isChecked() && !m_runner.isRunning()) m_clock.stop();
}

void RaceDock::showFrame(std::int64_t frame) {
    const std::int64_t last = m_recording->count() - 1;
    if (last < 0) return;
    m_frame = std::clamp<std::int64_t>(frame, 0, last);
    m_time = static_cast<double>(m_frame) * m_raced[0]->settings().step;
    m_slider->setValue(static_cast<int>(m_frame));
    if (const std::optional<RaceRecording::Moment> moment = m_recording->at(m_frame)) {
        m_views[0]->showSnapshot(moment->a);
        m_views[1]->showSnapshot(moment->b);
    }
    m_plot->setCursor(m_time);
}

void RaceDock::showPoints() {
    m_sinceChart.lap();
    for (const RacePoint& point : m_recording->pointsFrom(static_cast<std::int64_t>(m_times.size()))) {
        m_times.push_back(point.time);
        m_distances.push_back(point.apart.distance);
    }
    m_plot->setChart(chart());
    m_plot->setCursor(m_time);
    showDifference();
}

void RaceDock::showDifference() {
    const std::optional<BitDifference> first = m_recording->firstDifference();
    m_first->setEnabled(first.has_value());
    m_first->setText(
        first ? tr("first difference: frame %1, %2 s: %3 of %4")
                    .arg(QString::number(first->frame),
                         QString::number(static_cast<double>(first->frame) * m_raced[0]->settings().step, 'g',
                                         3),
                         QCoreApplication::translate("carom::Race", std::string(first->quantity).c_str()),
                         QString::fromStdString(m_raced[0]->scene().nameOf(first->body)))
              : tr("no bit differs in %1 frames").arg(std::max<std::int64_t>(0, m_recording->count() - 1)));
}

ChartSpec RaceDock::chart() const {
    ChartSpec spec;
    spec.x = {.label = tr("time"), .unit = QStringLiteral("s")};
    spec.y = {.label = tr("distance"), .unit = QStringLiteral("m"), .logarithmic = true};
    ChartSeries& series = spec.series.emplace_back();
    series.name = tr("greatest distance of a body from itself");
    series.x = m_times;
    series.y = m_distances;
    return spec;
}

QString RaceDock::exportTo(const QString& path) const {
    if (!m_recording) return tr("there was no race yet; choose Race first");
    if (!isCsv(path)) {
        ChartSpec spec = chart();
        spec.title = tr("Race");
        spec.note = m_sides[0].title->toolTip() + QLatin1Char('\n') + m_sides[1].title->toolTip();
        return writeChart(spec, path);
    }
    CsvTable table(raceColumns);
    for (const RacePoint& point : m_recording->pointsFrom(0)) addRow(table, point, m_raced[0]->scene());
    return saveFile(path, table.take());
}

} // namespace carom

#include "moc_race_dock.cpp"
