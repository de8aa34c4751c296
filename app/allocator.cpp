// SPDX-License-Identifier: GPL-3.0-or-later

// How jemalloc gets memory from the system: in pages as the system gives them. Large pages (`thp:always`)
// save the time of many small faults, but where the system must find them, as in a virtual machine, the first
// touch of one takes up to ten milliseconds: frames of a pile of 2,000 balls took up to 100 ms, of 10,000 up
// to 340, and take 12 and 95 without, the other frames the same to a percent. One arena: what threads
// allocate at one time is small.

extern "C" {
extern const char* malloc_conf; // read by jemalloc when the program starts
const char* malloc_conf = "narenas:1";
}
