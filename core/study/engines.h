// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/accuracy_run.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

// Other engines on the same scene, for comparison in an accuracy study. An engine is a program of its own,
// which a front end starts; what it prints is read here, line by line:
//
//     engine,NAME AND VERSION
//     differs,A RULE THAT IS NOT OURS          any number
//     lacks,WHAT IT CANNOT DO OF THE SCENE     then nothing follows
//     frame,time,body,label,x,y,z,...          the trace, as `carom run --trace` writes it, frame 0 first
//     0,0,1,,0.1,...
//     spent,MILLISECONDS                       of processor time, a line for each frame behind the start

namespace carom {

/// The arguments that the engine's program is started with.
std::vector<std::string> argumentsFor(const std::string& scene, const EngineRequest& request);

/// Reads that text in pieces, as they come.
class EngineOutput {
  public:
    /// `frame` is called for every complete frame of the trace, with all bodies.
    EngineOutput(const Pipeline& pipeline, std::function<void(const State&)> frame);

    void add(std::string_view piece);
    void end();

    const std::string& version() const { return m_version; }
    const std::vector<std::string>& differences() const { return m_differences; }
    /// What the engine cannot do of the scene; empty if it can do all.
    const std::string& lacking() const { return m_lacking; }
    const std::vector<double>& times() const { return m_times; } ///< [ms], by frame
    /// [ms] per simulated second, without the first frame, in which engines allocate; 0 if the program
    /// printed no times.
    double cost() const;
    std::int64_t frames() const { return m_frames; }         ///< complete ones, including the start
    const std::string& problem() const { return m_problem; } ///< what could not be read; empty if all could

  private:
    void readLine(std::string_view line);
    void readBody(std::string_view line);

    const Pipeline& m_pipeline;
    std::function<void(const State&)> m_frame;
    State m_state;
    std::string m_rest, m_version, m_lacking, m_problem;
    std::vector<std::string> m_differences;
    std::vector<double> m_times;
    std::size_t m_bodies = 0; // of the frame so far
    std::int64_t m_frames = 0;
    bool m_inTrace = false;
};

/// Adds the settings of these engines to a plan: 1 to 16 steps a frame, with the engine's own rules and with
/// rules set to Carom's.
void addEngines(AccuracyPlan& plan, const std::vector<std::string>& engines);

/// Runs the point's setting by the plan's program and fills in what its trace shows: the paths of the bodies,
/// impacts, energy, the final state. False if it was stopped.
bool measureEngine(const AccuracyRun& run, AccuracyPoint& point, std::vector<std::string>& notes);

} // namespace carom
