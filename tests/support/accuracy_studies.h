// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/text.h"

#include "core/simulation/build.h"
#include "core/study/accuracy.h"

#include <string>
#include <utility>
#include <vector>

// Small scenes, and studies of them.

namespace carom::test {

inline Scene parsed(const char* text) { return build(text).pipeline->scene(); }

inline Scene thrown() { return parsed("sphere { radius 0.1 mass 1 centre 0, 0, 0 vel 3, 4, 1 }"); }
inline Scene oscillating() {
    return parsed("gravity { accel 0, -9.81, 0 }\n"
                  "sphere bob { radius 0.1 mass 1 centre 0, 0.8, 0 }\n"
                  "spring { from world to bob fromAt 0, 2, 0 stiffness 100 length 1 }");
}
inline Scene tumbling() {
    return parsed("gravity { accel 0, 0, 0 }\n"
                  "cuboid { size 0.2, 0.4, 0.6 mass 1 centre 0, 0, 0 angvel 1, 2, 3 }");
}
inline Scene bouncing() {
    return parsed("wall { normal 0, 1, 0 toOrig 0 }\n"
                  "sphere { radius 0.1 mass 1 centre 0, 1, 0 vel 0.5, 0, 0 }");
}

inline AccuracyPlan quickPlan(const Scene& scene, std::vector<double> substeps, double duration) {
    AccuracyPlan plan = planFor(scene);
    vary(plan, substeps, {});
    plan.duration = duration;
    plan.runs = 1;
    return plan;
}

inline AccuracyStudy studied(const Scene& scene, const AccuracyPlan& plan, const KnownPoints& known = {}) {
    AccuracyListener listener;
    listener.goOn = [](double) { return true; };
    return runAccuracy(scene, plan, listener, known);
}

/// A millisecond of wall time passes at every step, and one of processor time at every reading: what a study
/// does then depends on its work alone.
struct CountedTime {
    double wall = 0, processor = 0;

    AccuracyListener listener() {
        AccuracyListener listener;
        listener.goOn = [this](double) {
            wall += 1;
            return true;
        };
        listener.clock = {[this] { return wall; }, [this] { return processor += 1; }};
        return listener;
    }
};

inline AccuracyStudy studiedByCount(const Scene& scene, const AccuracyPlan& plan) {
    CountedTime time;
    return runAccuracy(scene, plan, time.listener());
}

inline Scene resting() {
    return parsed("gravity { accel 0, -9.81, 0 }\n"
                  "wall { normal 0, 1, 0 toOrig 0 friction 0.5 }\n"
                  "cuboid { size 0.2, 0.2, 0.2 mass 1 centre 0, 0.1, 0 friction 0.5 elastic 0 }");
}
/// One ball among pegs, another on its own.
inline Scene pegsAndPasser() {
    return parsed("wall { normal 1, 0, 0 toOrig 1 }\nwall { normal -1, 0, 0 toOrig 1 }\n"
                  "wall { normal 0, 1, 0 toOrig 1 }\nwall { normal 0, -1, 0 toOrig 1 }\n"
                  "gravity { accel 0, 0, 0 }\n"
                  "sphere { radius 0.4 mass 1e9 centre 0.1, 0, 0 }\n"
                  "sphere among { radius 0.1 mass 1 centre -0.7, 0.55, 0 vel 25, 15, 0 }\n"
                  "sphere alone { radius 0.1 mass 1 centre 0.1, 0, 5 vel 0.1, 0, 0 }");
}

} // namespace carom::test
