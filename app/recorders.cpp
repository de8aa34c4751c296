// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/recorders.h"

#include "core/base/text.h"
#include "core/simulation/world.h"

#include <initializer_list>

namespace carom {
namespace {

void append(std::string& row, std::initializer_list<double> values) {
    for (const double value : values) row.append(",").append(shortest(value));
}

void append(std::string& row, const Vec3& v) { append(row, {v.x(), v.y(), v.z()}); }

} // namespace

TraceWriter::TraceWriter(const std::string& path, std::int64_t every) : m_file(path), m_every(every) {
    m_file.write("frame,time,body,label,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n");
}

void TraceWriter::record(const World& world) { record(world.pipeline(), world.state()); }

void TraceWriter::record(const Pipeline& pipeline, const State& state) {
    if (state.frame % m_every != 0) return;
    std::string row;
    for (const BodyIndex body : pipeline.bodies().mobileBodies) {
        const Quat& q = state.pose[body].orientation;
        row = std::to_string(state.frame);
        append(row, {state.time});
        row.append(",").append(std::to_string(body)).append(",").append(pipeline.scene().bodies[body].label);
        append(row, state.pose[body].position);
        append(row, {q.w(), q.x(), q.y(), q.z()});
        append(row, state.velocity[body]);
        append(row, state.angularVelocity[body]);
        m_file.write(row += '\n');
    }
}

StatisticsWriter::StatisticsWriter(const std::string& path) : m_file(path) {
    m_file.write(std::string(statisticsColumns()) + '\n');
}

void StatisticsWriter::record(const FrameStatistics& frame) { m_file.write(statisticsRow(frame) + '\n'); }

} // namespace carom
