#include "deck/sections/loaded_libraries.hpp"

#include "base/errors.hpp"

namespace strut::deck {

namespace {

using materials::UserLaw;

void load(const Material& material, UserLaw& law, const std::filesystem::path& folder, Problems& problems) {
  const std::filesystem::path file = std::filesystem::absolute(folder / law.function.file);
  const std::string where = "Materials > " + material.name + " > Library";
  const auto wrong = [&](const std::string& what) { problems.add(where, "'" + file.string() + "' " + what); };
  if (!std::filesystem::exists(file)) return wrong("does not exist");
  try {
    law.function = materials::loaded(file.string(), law.function.name, law.function.interface);
  } catch (const Error& error) {
    return wrong(error.what());
  }
  const materials::LibraryTrial trial = materials::tried(law);
  law.tells_energy = trial.tells_energy;
  if (!trial.problem.empty()) return wrong(trial.problem);
  if (!trial.warning.empty()) problems.note(where, "'" + file.string() + "' " + trial.warning);
}

}  // namespace

void load_user_libraries(std::vector<Material>& materials, const std::filesystem::path& folder, Problems& problems) {
  for (Material& material : materials) {
    if (auto* law = std::get_if<UserLaw>(&material.law)) load(material, *law, folder, problems);
  }
}

}  // namespace strut::deck
