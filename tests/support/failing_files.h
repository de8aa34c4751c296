// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A file system that fails on demand: this library stands before the C library's open, write, fsync, close,
// rename and fchmod, for every file of one folder, in the test itself and, by LD_PRELOAD, in a program it
// runs.

namespace carom::test {

/// While it lives, the `which`-th call of that name on a file of the folder fails with `cause`, and so do all
/// that follow it: a disk stays full. `write` on a full disk takes a part first, as a disk does.
class FailingFiles {
  public:
    /// `call` is "open", "write", "fsync", "close", "rename" or "fchmod"; `which` counts from 1.
    FailingFiles(const char* call, int which, int cause, const char* folder);
    ~FailingFiles();
    FailingFiles(const FailingFiles&) = delete;
    FailingFiles& operator=(const FailingFiles&) = delete;

    /// How often it has failed.
    int failures() const;
};

/// What a program finds in its environment instead: "CALL WHICH ERRNO FOLDER".
inline constexpr const char* failingFilesVariable = "CAROM_FAILING_FILES";

} // namespace carom::test
