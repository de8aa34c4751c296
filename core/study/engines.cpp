// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/engines.h"

#include "core/base/csv.h"
#include "core/base/text.h"
#include "core/dynamics/energy.h"
#include "core/solvers/solver.h"
#include "core/study/run_course.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>

namespace carom {
namespace {

/// Steps a frame of the finest setting of other engines. At twice a study takes twice as long for them.
constexpr int mostSteps = 16;
constexpr std::string_view traceHeading = "frame,time,body,label,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz";

} // namespace

std::vector<std::string> argumentsFor(const std::string& scene, const EngineRequest& request) {
    return {scene, "--frames=" + std::to_string(request.frames),
            "--substeps=" + std::to_string(request.substeps),
            request.isTuned ? "--iterations=" + std::to_string(request.iterations) : "--own-rules"};
}

EngineOutput::EngineOutput(const Pipeline& pipeline, std::function<void(const State&)> frame)
    : m_pipeline(pipeline), m_frame(std::move(frame)), m_state(pipeline.initialState()) {}

void EngineOutput::add(std::string_view piece) {
    m_rest.append(piece);
    std::size_t begin = 0;
    for (std::size_t end; (end = m_rest.find('\n', begin)) != std::string::npos; begin = end + 1)
        readLine(std::string_view(m_rest).substr(begin, end - begin));
    m_rest.erase(0, begin);
}

void EngineOutput::end() {
    if (!m_rest.empty() && m_problem.empty()) m_problem = "its last line has no end";
}

double EngineOutput::cost() const {
    if (m_times.size() < 2) return m_times.empty() ? 0 : m_times[0] / m_pipeline.settings().step;
    const double later = std::accumulate(m_times.begin() + 1, m_times.end(), 0.0);
    return later / (static_cast<double>(m_times.size() - 1) * m_pipeline.settings().step);
}

void EngineOutput::readLine(std::string_view line) {
    if (!m_problem.empty()) return;
    const std::size_t comma = std::min(line.find(','), line.size());
    const std::string_view word = line.substr(0, comma), rest = line.substr(std::min(comma + 1, line.size()));
    if (word == "engine")
        m_version = rest;
    else if (word == "differs")
        m_differences.emplace_back(rest);
    else if (word == "lacks")
        m_lacking = rest;
    else if (word == "spent")
        m_times.push_back(numberIn(rest).value_or(0));
    else if (line == traceHeading)
        m_inTrace = true;
    else if (m_inTrace)
        readBody(line);
    else
        m_problem = "`" + std::string(line.substr(0, 40)) + "` is no line of an engine";
}

void EngineOutput::readBody(std::string_view line) {
    constexpr std::size_t columns = 17;
    const std::vector<std::string_view> cells = csvSplit(line, ',');
    std::array<double, columns> value{};
    for (std::size_t k = 0; k < cells.size() && k < columns; ++k)
        value[k] = k == 3 ? 0 : numberIn(cells[k]).value_or(NAN); // 3 is the label
    const std::vector<BodyIndex>& mobile = m_pipeline.bodies().mobileBodies;
    const bool isRight = cells.size() == columns && m_bodies < mobile.size() &&
                         value[2] == static_cast<double>(mobile[m_bodies]) &&
                         value[0] == static_cast<double>(m_frames) &&
                         std::ranges::all_of(value, [](double v) { return std::isfinite(v); });
    if (!isRight) {
        m_problem = "`" + std::string(line.substr(0, 40)) + "` is no row of the trace, or not the next one";
        return;
    }
    const BodyIndex body = mobile[m_bodies++];
    m_state.pose[body] = {Vec3(value[4], value[5], value[6]), Quat(value[7], value[8], value[9], value[10])};
    m_state.velocity[body] = {value[11], value[12], value[13]};
    m_state.angularVelocity[body] = {value[14], value[15], value[16]};
    if (m_bodies < mobile.size()) return;
    m_state.frame = m_frames;
    m_state.time = value[1];
    m_bodies = 0;
    ++m_frames;
    m_frame(m_state);
}

void addEngines(AccuracyPlan& plan, const std::vector<std::string>& engines) {
    for (const std::string& engine : engines)
        for (const bool tuned : {false, true})
            for (int steps = 1; steps <= mostSteps; steps *= 2) {
                AccuracySetting setting{&generalSolver(), nullptr, steps, 0};
                setting.engine = engine;
                setting.isTuned = tuned;
                plan.settings.push_back(setting);
            }
    sortForStudy(plan);
}

bool measureEngine(const AccuracyRun& run, AccuracyPoint& point, std::vector<std::string>& notes) {
    const ReferenceSolution& reference = *run.study.reference;
    SimulationSettings options;
    options.method = std::string(generalSolver().name);
    options.step = run.step();
    const Pipeline pipeline(run.scene, options);
    const Bodies& bodies = pipeline.bodies();
    ErrorMeter meter(bodies, reference.size);
    RunCourse course(pipeline, reference.size);
    std::unique_ptr<ImpactWatch> impacts;
    State last = pipeline.initialState();
    EngineOutput output(pipeline, [&](const State& state) {
        const Invariants now = invariantsOf(bodies, state, pipeline.gravity());
        course.add(state.time, now.kinetic, now.potential);
        course.endFrame();
        if (impacts)
            impacts->look(state);
        else
            impacts = std::make_unique<ImpactWatch>(bodies, pipeline.gravity(), run.step(), state);
        const auto look = static_cast<std::size_t>(state.frame * reference.looksPerFrame);
        if (look < run.trajectory.samples.size())
            meter.add(state.pose, run.trajectory.samples[look], state.time, reference.horizons);
        last = state;
    });
    std::string problem =
        run.study.plan.runEngine({.engine = point.setting.engine,
                                  .isTuned = point.setting.isTuned,
                                  .substeps = point.setting.substeps,
                                  .frames = run.frames(),
                                  .limit = run.limit,
                                  .read = [&](std::string_view piece) { output.add(piece); },
                                  .goOn = run.goOn});
    if (!run.goOn()) return false;
    output.end();
    if (problem.empty()) problem = output.problem();
    if (problem.empty() && !output.lacking().empty()) problem = "it has no " + output.lacking();
    if (problem.empty() && output.frames() != run.frames() + 1) problem = "its trace ends too early";
    const std::string family = output.version() + (point.setting.isTuned ? ", tuned" : ", its own rules");
    for (const std::string& rule : output.differences())
        if (const std::string note = family + ": " + rule; std::ranges::count(notes, note) == 0)
            notes.push_back(note);
    point.status = PointStatus::Failed;
    point.reason = verbatim(problem);
    if (!problem.empty()) return true;
    point.times = {output.cost()};
    point.errors = meter.norms();
    point.energy = course.energy();
    if (!reference.energy.empty())
        point.energyOff = distanceOf(course.frames(), reference.energy, reference.energyScale);
    if (reference.outcome)
        point.outcome = differenceOf(course.outcome(pipeline, last), *reference.outcome, reference.size,
                                     run.study.duration);
    if (impacts && !reference.impacts.empty())
        point.impacts = compareImpacts(reference.impacts, impacts->record(), reference.horizons);
    judge(run.study, point);
    return true;
}

} // namespace carom
