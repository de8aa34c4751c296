// SPDX-License-Identifier: GPL-3.0-or-later

// How jemalloc gets memory from the system: in large pages where the system has them. The arrays of a scene
// grow while bodies come together, and every page that is touched for the first time stops the program: in a
// virtual machine a pile of 2,000 balls spent 20 of the 35 ms of its tenth frame on that. One arena: each has
// large pages of its own, and what threads allocate at one time is small.

extern "C" {
extern const char* malloc_conf; // read by jemalloc when the program starts
const char* malloc_conf = "thp:always,metadata_thp:auto,narenas:1";
}
