#pragma once

#include <filesystem>

namespace strut::io {

// What has been written to the file so far is on the disk when this returns: a power cut does not take it. Throws
// Error.
void force_to_disk(const std::filesystem::path& path);

}  // namespace strut::io
