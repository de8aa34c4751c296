// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/types.h"

#include <LinearMath/btQuaternion.h>
#include <LinearMath/btVector3.h>

namespace carom {

inline btVector3 toBullet(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline Vec3 fromBullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
inline btQuaternion toBullet(const Quat& q) { return {q.x(), q.y(), q.z(), q.w()}; }
inline Quat fromBullet(const btQuaternion& q) { return {q.w(), q.x(), q.y(), q.z()}; }

} // namespace carom
