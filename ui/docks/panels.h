// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/docks/accuracy_dock.h"
#include "ui/docks/breakpoints_dock.h"
#include "ui/docks/broadphase_dock.h"
#include "ui/docks/checks_dock.h"
#include "ui/docks/effects_dock.h"
#include "ui/docks/inspector_dock.h"
#include "ui/docks/outline_dock.h"
#include "ui/docks/output_dock.h"
#include "ui/docks/plots_dock.h"
#include "ui/docks/problems_dock.h"
#include "ui/docks/race_dock.h"
#include "ui/docks/stability_dock.h"
#include "ui/docks/sweep_dock.h"
#include "ui/docks/timing_dock.h"

// Every panel of panels.def.
