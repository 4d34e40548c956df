// A process that tries inputs one after the other, under limits, and records the number of the present one, so that the
// process that started it knows the input at which it died.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace strut::fuzz {

struct Options {
  std::uint64_t seed = 1;
  std::uint64_t first = 0, inputs = 3000;
  double minutes = 0;   // in place of a number of inputs
  std::string subject;  // this one only
  std::filesystem::path keep = "fuzz-failures";
  std::filesystem::path file;  // this input only
  bool leaks_of_each = false;
  double seconds = 10;  // of the processor, for one input
};

// Shared by the two processes.
struct Word {
  volatile std::uint64_t input;     // number of the present input
  volatile std::uint64_t accepted;  // inputs so far that gave no Error
  volatile bool ready;              // the samples are made
  char subject[32];
  char file[256];
  char problem[2000];
};

enum Exit { done = 0, wrong_error = 41, too_slow = 42, leaked = 43, broken_sample = 44 };

// Tries the inputs [first, last) and ends the process.
[[noreturn]] void work(const Options& options, const std::filesystem::path& folder, std::uint64_t first,
                       std::uint64_t last, Word& word);

}  // namespace strut::fuzz
