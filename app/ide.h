// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace carom {

/// What `--picture FILE [--at FRAME] [--size WxH]` asks for.
struct PictureRequest {
    std::string file;
    std::int64_t frame = 0;
    int width = 960;  ///< [px]
    int height = 600; ///< [px]
};

/// What `carom [SCENE] [-n FRAMES] [--play] [--screenshot FILE]` asks of the IDE.
struct IdeRequest {
    std::string program = "carom";         ///< the program's own name, argv[0]
    std::optional<std::string> scene;      ///< a file; absent: the welcome page or the last session
    std::optional<std::int64_t> frames;    ///< leave after this many rendered frames, print the timing
    bool play = false;                     ///< start playing at once
    std::optional<std::string> screenshot; ///< save the window here before leaving (PNG)
    std::optional<PictureRequest> picture; ///< save the scene's picture and leave; no window is opened
};

/// Opens the IDE; returns the program's exit code. In app/ide.cpp, which knows Qt.
int runIde(const IdeRequest& request);

} // namespace carom
