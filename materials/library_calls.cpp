#include "materials/library_calls.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <memory>

namespace strut::materials::library_calls {

namespace {

struct Call {
  const char* file = nullptr;  // of the library that this thread is in
  const Points* points = nullptr;
  int point = -1;  // index of the one that the library computes; -1: all
};
thread_local Call call;

// ---- For signal handlers: nothing here allocates memory -------------------------------------------------------------

void tell(const char* text) {
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) return;
}

void tell(double number) {
  char text[32] = {};
  std::to_chars(text, text + sizeof(text) - 1, number, std::chars_format::general, 6);
  tell(text);
}

void tell_place(const double* X) {
  for (int c = 0; c < 3; ++c) {
    tell(c == 0 ? "(" : ", ");
    tell(X[c]);
  }
  tell(") m");
}

void tell_fault(const char* what) {
  tell("\nstrut: the library ");
  tell(call.file);
  tell(what);
  if (call.points && call.points->count > 0) {
    const bool one = call.point >= 0 || call.points->count == 1;
    tell(one ? " at the point with the reference position " : " at one of the points next to the reference position ");
    tell_place(call.points->places[one ? std::clamp(call.point, 0, call.points->count - 1) : 0]);
  }
  tell(": a fault of that library\n");
}

constexpr std::array signals{SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT};
std::array<struct sigaction, signals.size()> before;  // the handlers before watch()

// Several threads may meet the fault at once, where points begin to flow: the first one tells of it and ends the
// program, the others wait for that.
std::atomic_flag is_ending;
thread_local bool ends_it = false;

void hold_all_but_first_thread() {
  if (ends_it) return;
  ends_it = !is_ending.test_and_set();
  while (!ends_it) pause();
}

void on_crash(int signal) {
  hold_all_but_first_thread();
  if (call.file) tell_fault(" of a User Library material crashed");
  for (std::size_t k = 0; k < signals.size(); ++k) {
    if (signals[k] == signal) sigaction(signal, &before[k], nullptr);
  }
  std::raise(signal);
}

// ---------------------------------------------------------------------------------------------------------------------

// Fortran's STOP exits with status 0, which would hide that the run has failed. The other exit handlers are left out:
// glibc's list of them breaks where two threads exit at once, and a crash leaves them out too.
void on_exit() {
  if (!call.file) return;
  hold_all_but_first_thread();
  std::cout.flush();
  tell_fault(" of a User Library material ended the program (STOP, XIT, exit)");
  _exit(EXIT_FAILURE);
}

// glibc calls on_exit in one of the threads that exit at once. The others come here, last of all, and are held.
struct LastAtExit {
  ~LastAtExit() {
    if (is_ending.test()) hold_all_but_first_thread();
  }
} last_at_exit;

// Stack of this thread for signal handlers: a library may crash because it has used up the thread's own stack.
struct SecondStack {
  SecondStack() {
    stack_t other{};
    sigaltstack(nullptr, &other);
    if (!(other.ss_flags & SS_DISABLE)) return;  // the thread has one already
    memory = std::make_unique<char[]>(size);
    const stack_t mine{.ss_sp = memory.get(), .ss_flags = 0, .ss_size = size};
    sigaltstack(&mine, nullptr);
  }
  ~SecondStack() {
    const stack_t none{.ss_sp = nullptr, .ss_flags = SS_DISABLE, .ss_size = 0};
    if (memory) sigaltstack(&none, nullptr);
  }
  SecondStack(const SecondStack&) = delete;
  SecondStack& operator=(const SecondStack&) = delete;

  static constexpr std::size_t size = 65536;
  std::unique_ptr<char[]> memory;
};

}  // namespace

void watch() {
  static const bool once = [] {
    struct sigaction action = {};
    action.sa_handler = on_crash;
    action.sa_flags = SA_ONSTACK;
    for (std::size_t k = 0; k < signals.size(); ++k) sigaction(signals[k], &action, &before[k]);
    return std::atexit(on_exit) == 0;
  }();
  static_cast<void>(once);
}

void stand_at(const Points* points) { call.points = points; }

Inside::Inside(const std::string& file) {
  thread_local const SecondStack stack;
  static_cast<void>(stack);
  call.point = -1;
  call.file = file.c_str();
}
Inside::~Inside() { call.file = nullptr; }
void Inside::takes(int point) { call.point = point; }

}  // namespace strut::materials::library_calls
