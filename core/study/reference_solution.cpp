// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/reference_solution.h"

#include "core/base/figures.h"
#include "core/math/statistics.h"
#include "core/simulation/method_choice.h"
#include "core/simulation/world.h"
#include "core/study/closed_motion.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace carom {
namespace {

/// Initial distance of copies, relative to the scene's size: of exact ones above rounding, of others above
/// the tolerance of their contacts; and the factor by which it has grown where they count as diverged. At ten
/// times the factor horizons are later by the time in which distances grow tenfold, and errors at them ten
/// times larger.
constexpr double exactApart = 1e-12, runsApart = 1e-9, divergedBy = 1e3;
/// Errors of a closed form and of exact events: rounding of a few thousand operations. At a tenth, settings
/// are compared by rounding.
constexpr double roundingOfReference = 1e-13;
/// Samples a frame where states between frames are available: errors are measured there, too. With half as
/// many the largest error of a motion with a period of two frames may be missed.
constexpr int looksBetween = 8;
/// Substeps of the first of the converging runs; a multiple of the samples. At twice, expensive scenes have
/// time for one run less.
constexpr int firstSubsteps = 8;
/// How much finer than the finest setting the last run is: at half, its own error is a quarter of that
/// setting's for a method of order two. And the difference of runs at which refinement ends: rounding. At a
/// tenth of that rounding keeps it from ending; at ten times, one digit of the reference may be lost.
constexpr int finerThanFinest = 4;
constexpr double convergedEnough = 1e-13;
/// Refinement ends after so many runs in a row that neither diverge later nor agree better by these factors.
/// At twice the first, chaotic scenes take twice as long for the same result; at half, a single unlucky run
/// ends it. Factors nearer to 1 let chance count as progress; twice as far from it, that of a method of order
/// one would not count.
constexpr int mostStalls = 2;
constexpr double furtherOn = 1.1, muchBetter = 0.7;
/// Of the time for converging runs, the part that the first one may take: its copy takes as long, and a finer
/// run twice. At twice, there may be no time for the finer run; at half, expensive scenes have no time for
/// the first.
constexpr double partOfFirst = 0.25;
/// The part of the remaining time for copies that measure chance, and their number at most: with half as
/// many, the largest difference among them is exceeded by another run twice as often.
constexpr double partOfChance = 0.15;
constexpr int copiesOfChance = 8;
/// A run that has not simulated the second part when the first part of its time is over is given up: steps
/// become more expensive as bodies meet. At half of both, runs with an expensive start are given up too
/// early.
constexpr double hopelessBy = 0.25, hopelessAt = 0.125;

/// How well the contacts of a run are solved.
struct Grade {
    const char* preset = "accurate";
    std::optional<double> tolerance = 1e-12; ///< or the preset's own
};
constexpr Grade finestGrade{}, affordableGrade{"default", std::nullopt};

SimulationSettings optionsFor(const char* method, const char* integrator, double step,
                              const Grade& grade = finestGrade) {
    SimulationSettings options;
    options.method = method;
    options.integrator = integrator;
    options.step = step;
    options.substeps = 1;
    options.preset = grade.preset;
    options.tolerance = grade.tolerance;
    return options;
}

/// The samples of a run.
struct Recorded {
    Trajectory trajectory{};
    ImpactRecord impacts{};
    std::optional<Outcome> outcome{}; ///< of a run that came to its end
    std::vector<double> energy{};     ///< [J] at the ends of frames, the start first
    double energyScale = 1;           ///< [J]
    double seconds = 0;               ///< [s] of wall time

    double duration() const {
        return static_cast<double>(trajectory.samples.size() - 1) * trajectory.spacing;
    }
};

/// How a run is made and sampled.
struct Course {
    const Scene& scene;
    SimulationSettings options;
    int looksPerFrame = 1;
    int perLook = 1;      ///< steps of the options
    double seconds = 0;   ///< [s] of wall time that it may take
    bool isTrial = false; ///< of no use unless it comes to its end
};

/// What of a request is still to be done, with the frames that fit.
class Search {
  public:
    explicit Search(const ReferenceRequest& request)
        : m_request(request), m_begin(request.clock.wall()),
          m_frames(
              static_cast<std::int64_t>(std::ceil(request.duration / request.settings.step * (1 - 1e-12)))) {}

    const ReferenceRequest& request() const { return m_request; }
    std::int64_t frames() const { return m_frames; }
    double left() const { return m_request.seconds - 1e-3 * (m_request.clock.wall() - m_begin); } ///< [s]
    bool stopped() const { return m_stopped; }

    /// The whole frames of a run that its time is enough for; nothing if told to stop or if the state is
    /// lost.
    std::optional<Recorded> record(const Course& course);
    /// Later runs are no longer than this one.
    void shortenTo(const Recorded& run);
    bool isHopeless(std::int64_t frame, double partOfTime) const {
        return partOfTime > hopelessBy &&
               static_cast<double>(frame) < hopelessAt * static_cast<double>(m_frames);
    }

  private:
    bool goOn() {
        m_stopped = m_stopped || !m_request.goOn();
        return !m_stopped;
    }

    const ReferenceRequest& m_request;
    double m_begin; // [ms]
    std::int64_t m_frames;
    bool m_stopped = false;
};

std::optional<Recorded> Search::record(const Course& course) {
    const double step = m_request.settings.step, begin = m_request.clock.wall();
    World world(std::make_shared<const Pipeline>(course.scene, course.options));
    const Pipeline& pipeline = world.pipeline();
    Recorded run{.trajectory = {step / course.looksPerFrame, {world.state().pose}}};
    ImpactWatch impacts(pipeline.bodies(), pipeline.gravity(), step, world.state());
    RunCourse energies(world, sizeOf(pipeline.bodies(), run.trajectory));
    const auto spent = [&] { return 1e-3 * (m_request.clock.wall() - begin); };
    bool hasTime = true;
    for (std::int64_t frame = 0; frame < m_frames && hasTime; ++frame) {
        for (int look = 0; look < course.looksPerFrame && hasTime; ++look) {
            for (int k = 0; k < course.perLook && hasTime; ++k) {
                world.step();
                if (!goOn() || !world.health().finite) return std::nullopt;
                energies.add(world);
                hasTime = spent() <= course.seconds;
                if (course.isTrial && isHopeless(frame, spent() / course.seconds)) return run;
            }
            run.trajectory.samples.push_back(world.state().pose);
        }
        impacts.look(world.state());
        energies.endFrame();
    }
    run.seconds = spent();
    const std::size_t whole =
        (run.trajectory.samples.size() - 1) / static_cast<std::size_t>(course.looksPerFrame);
    const bool isWhole = hasTime || (run.trajectory.samples.size() - 1 ==
                                     static_cast<std::size_t>(m_frames * course.looksPerFrame));
    // A frame that time ran out in may be broken off.
    const std::size_t frames = isWhole ? whole : std::max<std::size_t>(whole, 1) - 1;
    run.trajectory.samples.resize(frames * static_cast<std::size_t>(course.looksPerFrame) + 1);
    if (ImpactWatch::sees(pipeline.bodies())) run.impacts = impacts.record();
    if (isWhole) run.outcome = energies.outcome(world);
    run.energy = energies.frames();
    run.energy.resize(frames + 1);
    run.energyScale = energies.energyScale();
    return run;
}

void Search::shortenTo(const Recorded& run) {
    m_frames =
        std::min(m_frames, static_cast<std::int64_t>(std::llround(run.duration() / m_request.settings.step)));
}

/// What the horizons of the mobile bodies say together.
void summariseHorizons(const Bodies& bodies, ReferenceSolution& reference) {
    std::vector<double> times;
    for (const BodyIndex i : bodies.mobileBodies) times.push_back(reference.horizons[i]);
    if (times.empty()) return;
    reference.horizon = summarise(times).median;
    reference.firstHorizon = *std::min_element(times.begin(), times.end());
    reference.mobile = times.size();
    reference.followed = static_cast<std::size_t>(
        std::ranges::count_if(times, [&](double time) { return time >= reference.duration; }));
    reference.chaotic = reference.followed < reference.mobile;
}

/// How fast a nudged copy diverges from the run, in the same setting, and where.
void measureChaos(const Trajectory& run, const Trajectory& copy, const Bodies& bodies,
                  ReferenceSolution& reference) {
    reference.horizons =
        horizonsOf(run, copy, bodies, reference.size, {Deviation::Surface, divergedBy * reference.nudge});
    reference.duration = static_cast<double>(run.common(copy) - 1) * run.spacing;
    summariseHorizons(bodies, reference);
    if (reference.chaotic && reference.firstHorizon > 0)
        reference.growth = std::log(divergedBy) / reference.firstHorizon;
}

/// How far runs of the scene that should be alike differ in what does not follow single bodies.
struct Scatter {
    double outcome = 0; ///< as OutcomeErrors::worst
    double energy = 0;  ///< relative to the energy exchanged

    /// `size` of the scene [m].
    void include(const Recorded& run, const Recorded& other, double size) {
        if (run.outcome && other.outcome)
            outcome =
                std::max(outcome, differenceOf(*other.outcome, *run.outcome, size, run.duration()).worst());
        energy = std::max(energy, distanceOf(other.energy, run.energy, run.energyScale));
    }
    void writeTo(ReferenceSolution& reference) const {
        reference.outcomeScatter = outcome;
        reference.energyScatter = energy;
    }
};

/// What all kinds have in common, of the run that they end with.
void conclude(const Bodies& bodies, Recorded&& run, ReferenceSolution& reference) {
    reference.duration = run.duration();
    for (double& horizon : reference.horizons) horizon = std::min(horizon, reference.duration);
    summariseHorizons(bodies, reference);
    reference.way = largestWay(run.trajectory, bodies, reference.size);
    reference.trajectory = std::move(run.trajectory);
    reference.impacts = std::move(run.impacts);
    reference.outcome = run.outcome;
    reference.energy = std::move(run.energy);
    reference.energyScale = run.energyScale;
}

ReferenceSolution closedReference(const ReferenceRequest& request, const ClosedMotion& motion,
                                  const Bodies& bodies, std::int64_t frames) {
    ReferenceSolution reference{
        .kind = ReferenceKind::ClosedForm, .description = motion.name, .looksPerFrame = looksBetween};
    Recorded run;
    run.trajectory.spacing = request.settings.step / looksBetween;
    for (std::int64_t look = 0; look <= frames * looksBetween; ++look)
        run.trajectory.samples.push_back(motion.at(static_cast<double>(look) * run.trajectory.spacing));
    reference.size = sizeOf(bodies, run.trajectory);
    reference.error = roundingOfReference;
    reference.horizons.assign(bodies.count(), run.duration());
    conclude(bodies, std::move(run), reference);
    return reference;
}

std::optional<ReferenceSolution> exactReference(Search& search, const Bodies& bodies) {
    const ReferenceRequest& request = search.request();
    const auto course = [&](const Scene& scene) {
        return Course{.scene = scene,
                      .options = optionsFor("events", "euler", request.settings.step / looksBetween),
                      .looksPerFrame = looksBetween,
                      .seconds = partOfFirst * search.left(),
                      .isTrial = !request.settings.method->isExact};
    };
    std::optional<Recorded> run = search.record(course(request.scene));
    if (!run || run->trajectory.samples.size() < 2) return std::nullopt;
    if (!run->outcome && !request.settings.method->isExact) return std::nullopt;
    search.shortenTo(*run);
    ReferenceSolution reference{.kind = ReferenceKind::ExactEvents,
                                .looksPerFrame = looksBetween,
                                .size = sizeOf(bodies, run->trajectory),
                                .error = roundingOfReference,
                                .nudge = exactApart};
    const std::optional<Recorded> copy =
        search.record(course(nudged(request.scene, exactApart * reference.size)));
    if (!copy) return std::nullopt;
    measureChaos(run->trajectory, copy->trajectory, bodies, reference);
    Scatter scatter;
    scatter.include(*run, *copy, reference.size);
    scatter.writeTo(reference);
    conclude(bodies, std::move(*run), reference);
    if (!reference.chaotic) return reference;
    // Within the horizon rounding has grown as the distance of the copies has.
    reference.error = roundingOfReference * divergedBy;
    const double enough = search.left() / 2;
    CrowdRun crowd{.scene = request.scene,
                   .frames = search.frames(),
                   .first = framesToForget(reference.growth, request.settings.step),
                   .step = request.settings.step,
                   .nudge = crowdNudge * reference.size,
                   .goOn = request.goOn,
                   .hasTime = [&] { return search.left() > enough; }};
    reference.crowd = exactCrowd(crowd, bodies, request.copies);
    return reference;
}

/// Runs with more and more substeps.
class Convergence {
  public:
    Convergence(Search& search, const Pipeline& pipeline)
        : m_search(search), m_bodies(pipeline.bodies()),
          m_integrator(!m_bodies.springs.empty() || m_bodies.count() == 1 ? "rk4" : "midpoint"),
          m_looks(anyCanMeet(m_bodies) ? 1 : looksBetween) {}

    std::optional<ReferenceSolution> find() {
        if (!begin()) return std::nullopt;
        if (m_reference.chaotic) watchChance();
        while (m_substeps < most() && m_stalls < mostStalls && m_reference.error > convergedEnough)
            if (!refine()) break;
        if (m_search.stopped()) return std::nullopt;
        m_reference.description =
            verbatim(std::string("contacts, ") + m_integrator + ", preset " + m_grade.preset);
        m_reference.description.add(Sentence{", %1 substeps", {std::to_string(m_substeps)}}, "");
        conclude(m_bodies, std::move(*m_run), m_reference);
        return std::move(m_reference);
    }

  private:
    /// Substeps of the last run.
    int most() const { return std::max(finerThanFinest * m_search.request().finest, 8 * firstSubsteps); }

    std::optional<Recorded> record(const Scene& scene, int substeps, double seconds, bool isTrial = false) {
        return m_search.record({.scene = scene,
                                .options = optionsFor("contacts", m_integrator,
                                                      m_search.request().settings.step / substeps, m_grade),
                                .looksPerFrame = m_looks,
                                .perLook = substeps / m_looks,
                                .seconds = seconds,
                                .isTrial = isTrial});
    }
    /// A run of this grade, with few substeps; a state that is lost at one step may be kept at half of it.
    void runFirst(const Grade& grade, int substeps, double seconds, bool isTrial) {
        m_grade = grade;
        m_run.reset();
        for (m_substeps = substeps; !m_run && !m_search.stopped() && m_substeps < most();) {
            m_run = record(m_search.request().scene, m_substeps, seconds, isTrial);
            if (!m_run) m_substeps *= 2;
        }
    }

    /// The first run, and how a copy of it diverges.
    bool begin() {
        const ReferenceRequest& request = m_search.request();
        double share = partOfFirst * m_search.left();
        runFirst(finestGrade, firstSubsteps, share, m_looks == 1);
        if (m_looks == 1 && (!m_run || !m_run->outcome) && !m_search.stopped()) {
            share = partOfFirst * m_search.left();
            runFirst(affordableGrade, std::min(firstSubsteps, request.settings.substeps), share, false);
        }
        if (!m_run || m_run->trajectory.samples.size() < 2) return false;
        m_search.shortenTo(*m_run);
        m_reference.looksPerFrame = m_looks;
        m_reference.size = sizeOf(m_bodies, m_run->trajectory);
        m_reference.error = HUGE_VAL;
        m_reference.nudge = runsApart;
        const std::optional<Recorded> copy =
            record(nudged(request.scene, runsApart * m_reference.size), m_substeps, share);
        if (!copy) return false;
        measureChaos(m_run->trajectory, copy->trajectory, m_bodies, m_reference);
        m_beforeChaos = m_reference.horizons;
        m_ofCopy.include(*m_run, *copy, m_reference.size);
        m_ofCopy.writeTo(m_reference);
        return true;
    }

    /// Where trajectories are chaotic, the final state is random in part: copies of a cheap setting measure
    /// how much.
    void watchChance() {
        const double until = (1 - partOfChance) * m_search.left();
        const int substeps = m_looks * std::max(1, m_search.request().settings.substeps / m_looks);
        std::optional<Recorded> first;
        std::swap(m_grade, m_gradeOfChance);
        for (int copy = 0; copy < copiesOfChance && m_search.left() > until; ++copy) {
            const Scene scene = nudged(m_search.request().scene, runsApart * m_reference.size,
                                       static_cast<std::uint64_t>(copy));
            std::optional<Recorded> run = record(scene, substeps, m_search.left() - until);
            if (!run || !run->outcome) break;
            if (first)
                m_ofCopy.include(*first, *run, m_reference.size);
            else
                first = std::move(run);
        }
        std::swap(m_grade, m_gradeOfChance);
        m_ofCopy.writeTo(m_reference);
    }

    /// A run with twice the substeps, if there is time for it.
    bool refine() {
        const double left = m_search.left();
        if (2 * m_run->seconds > left) return false;
        std::optional<Recorded> finer = record(m_search.request().scene, 2 * m_substeps, left);
        if (!finer || !finer->outcome) return false;
        const double followed = sum(m_reference.horizons), error = m_reference.error;
        const Horizons together = horizonsOf(m_run->trajectory, finer->trajectory, m_bodies, m_reference.size,
                                             {Deviation::Error, m_search.request().agreement});
        for (std::size_t i = 0; i < together.size(); ++i)
            m_reference.horizons[i] = std::min(m_beforeChaos[i], together[i]);
        m_reference.error =
            distanceOf(m_run->trajectory, finer->trajectory, m_bodies, m_reference.size, m_reference.horizons)
                .worst();
        Scatter scatter = m_ofCopy; // runs coarser than the last two do not count
        scatter.include(*finer, *m_run, m_reference.size);
        scatter.writeTo(m_reference);
        const bool stalls = std::isfinite(error) && m_reference.error > muchBetter * error &&
                            sum(m_reference.horizons) < furtherOn * followed;
        m_stalls = stalls ? m_stalls + 1 : 0;
        m_run = std::move(finer);
        m_substeps *= 2;
        return true;
    }

    double sum(const Horizons& horizons) const {
        double total = 0;
        for (const BodyIndex i : m_bodies.mobileBodies) total += horizons[i];
        return total;
    }

    Search& m_search;
    const Bodies& m_bodies;
    const char* m_integrator;
    int m_looks;
    ReferenceSolution m_reference;
    std::optional<Recorded> m_run; // the finest so far
    Horizons m_beforeChaos;
    Scatter m_ofCopy;
    Grade m_grade, m_gradeOfChance = affordableGrade;
    int m_substeps = firstSubsteps;
    int m_stalls = 0;
};

/// Something to be relative to where nothing can be followed.
ReferenceSolution noReference(const Pipeline& pipeline, const ReferenceRequest& request) {
    const Trajectory start{request.settings.step, {pipeline.initialState().pose}};
    ReferenceSolution reference{.kind = ReferenceKind::None, .description = noReferenceReason()};
    reference.size = sizeOf(pipeline.bodies(), start);
    reference.duration = request.duration;
    reference.horizons.assign(pipeline.bodies().count(), 0);
    reference.way = HUGE_VAL;
    return reference;
}

} // namespace

Sentence noReferenceReason() {
    return Sentence{"no run of the most accurate setting came to an end with its state whole"};
}

std::string_view nameOf(ReferenceKind kind) {
    switch (kind) {
    case ReferenceKind::ClosedForm:
        return "closed form";
    case ReferenceKind::ExactEvents:
        return "exact events";
    case ReferenceKind::ConvergedRun:
        return "converged run";
    case ReferenceKind::None:
        return "none";
    }
    return {};
}

std::optional<ReferenceSolution> findReferenceSolution(const ReferenceRequest& request) {
    const Pipeline pipeline(request.scene, optionsFor("contacts", "rk4", request.settings.step));
    Search search(request);
    if (const std::optional<ClosedMotion> motion = closedMotionOf(pipeline))
        return closedReference(request, *motion, pipeline.bodies(), search.frames());
    const SolverRow* events = findSolver("events");
    if (!objectionTo(*events, request.scene)) {
        if (std::optional<ReferenceSolution> reference = exactReference(search, pipeline.bodies()))
            return reference;
        if (search.stopped()) return std::nullopt;
    }
    if (std::optional<ReferenceSolution> reference = Convergence(search, pipeline).find()) return reference;
    if (search.stopped()) return std::nullopt;
    return noReference(pipeline, request);
}

} // namespace carom
