// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/failing_memory.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> refused = SIZE_MAX; // [bytes] and more
std::atomic<int> refusingThread = 0;         // that gets everything
std::atomic<long> left = -1;                 // requests until the one that is refused; below 0: none is
std::array<char, 4096> told{};               // file

void readEnvironment() {
    const char* words = std::getenv(carom::test::failingMemoryVariable);
    long number = 0;
    if (words && std::sscanf(words, "%ld %4095s", &number, told.data()) == 2) left = number;
}

bool isRefused(std::size_t bytes) {
    if (bytes >= refused && ::gettid() != refusingThread) return true;
    if (left < 0 || left.fetch_sub(1) != 1) return false;
    const int file = ::open(told.data(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    if (file >= 0) ::close(file);
    return true;
}

void* allocated(std::size_t bytes, std::size_t alignment) {
    if (isRefused(bytes)) return nullptr;
    if (alignment == 0) return std::malloc(bytes == 0 ? 1 : bytes);
    return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}

void* orThrow(void* memory) {
    if (!memory) throw std::bad_alloc();
    return memory;
}

} // namespace

namespace carom::test {

FailingMemory::FailingMemory(std::size_t atLeast) {
    refusingThread = ::gettid();
    refused = atLeast;
}
FailingMemory::~FailingMemory() { refused = SIZE_MAX; }

} // namespace carom::test

void* operator new(std::size_t bytes) { return orThrow(allocated(bytes, 0)); }
void* operator new[](std::size_t bytes) { return orThrow(allocated(bytes, 0)); }
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept { return allocated(bytes, 0); }
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept { return allocated(bytes, 0); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
    return orThrow(allocated(bytes, static_cast<std::size_t>(alignment)));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
    return orThrow(allocated(bytes, static_cast<std::size_t>(alignment)));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

/// The first thing `main` does with the system: what is built before it is none of its business.
extern "C" sighandler_t signal(int number, sighandler_t handler) noexcept {
    using Signal = sighandler_t (*)(int, sighandler_t);
    static const auto inner = reinterpret_cast<Signal>(::dlsym(RTLD_NEXT, "signal"));
    if (number == SIGPIPE && handler == SIG_IGN) readEnvironment();
    return inner(number, handler);
}
