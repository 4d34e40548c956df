#include "mesh/resolution.hpp"

#include <cstdio>

#include "mechanics/expected_error.hpp"

namespace strut::mesh {

std::string resolution_of(const std::string& members, double cells) {
  char text[100];
  std::snprintf(text, sizeof text, "  %s %.4g cells thick: by quadratic correspondence expect ", members.c_str(),
                cells);
  return text + expected_error_text(cells, "in the plateau, where metal flows") + " (docs/resolution.md)\n";
}

}  // namespace strut::mesh
