// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/command.h"
#include "app/errors.h"
#include "app/files.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/scene_options.h"
#include "core/base/text.h"
#include "core/simulation/touching.h"
#include "core/simulation/world.h"

#include <algorithm>
#include <limits>

namespace carom {

CommandRow contactsCommand();

namespace {

void append(std::string& row, const Vec3& v) {
    for (Eigen::Index k = 0; k < 3; ++k) row.append(",").append(shortest(v[k]));
}

std::string rowsOf(const TouchingPair& touching) {
    std::string rows;
    for (const ContactPoint& point : touching.manifold) {
        rows += std::to_string(touching.pair.a) + "," + std::to_string(touching.pair.b) + ",";
        rows += shortest(std::max(0.0, -point.separation));
        append(rows, touching.manifold.normal);
        append(rows, point.onA);
        append(rows, point.onB);
        rows += "\n";
    }
    return rows;
}

int runContacts(const Arguments& arguments) {
    const SimulationSettings options = simulationSettings(arguments);
    const std::int64_t frame =
        arguments.wholeNumber("at", 0, std::numeric_limits<std::int64_t>::max()).value_or(0);
    const Build built = loadScene(arguments.operands.front(), options);
    World world(built.pipeline);
    catchInterrupts();
    InterruptibleWork work([] {}); // rows are written as they are found
    {
        Progress progress(frame);
        while (world.state().frame < frame && world.health().finite && !interrupted()) {
            work.step([&] { world.step(); });
            progress.update(world.state().frame);
        }
    }
    if (interrupted()) return exitcode::interrupted;
    if (!world.health().finite) {
        printError(describeLoss("carom contacts", world));
        return exitcode::unphysical;
    }
    OutputFile output("-");
    output.write("a,b,depth,nx,ny,nz,ax,ay,az,bx,by,bz\n");
    work.step([&] {
        forEachTouchingPair(built.pipeline->bodies(), world.state(), [&](const TouchingPair& touching) {
            output.write(rowsOf(touching));
            return !interrupted();
        });
    });
    output.close();
    return interrupted() ? exitcode::interrupted : exitcode::done;
}

} // namespace

CommandRow contactsCommand() {
    std::vector<OptionRow> options = {
        {"at", 0, "FRAME", "simulate up to this frame first (default 0: the scene as written)"}};
    const std::vector<OptionRow> shared = simulationOptions();
    options.insert(options.end(), shared.begin(), shared.end());
    return {.name = "contacts",
            .summary = "List the pairs that touch or overlap, as CSV",
            .operands = "SCENE",
            .example = "carom contacts scenes/table.sdl --at 60",
            .options = options,
            .details =
                "Columns: a,b the two bodies, counted from 0 over all built bodies, walls included; depth of "
                "the overlap in m; nx,ny,nz the unit normal from a to b; ax,ay,az and bx,by,bz the contact "
                "point on each body. One row a contact point, pairs ascending.",
            .leastOperands = 1,
            .mostOperands = 1,
            .run = runContacts};
}

} // namespace carom
