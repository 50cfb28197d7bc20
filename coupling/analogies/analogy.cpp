#include "coupling/analogies/analogy.hpp"

#include <utility>

#include "core/base/case_table.hpp"
#include "core/base/error.hpp"
#include "coupling/analogies/ape.hpp"
#include "coupling/analogies/lighthill.hpp"
#include "coupling/analogies/pcwe.hpp"
#include "coupling/analogies/pressure_rate.hpp"
#include "coupling/analogies/vortex.hpp"

namespace vocalis::coupling {

namespace {

using Settings = acoustic::AnalogySettings;

/// Silence: the acoustic solver runs with its own sources only.
class NoAnalogy : public Analogy {
 public:
  explicit NoAnalogy(AnalogyMedium) {}
  AnalogySource source(const FlowView& flow) const override {
    return {fem::Load(*flow.space, 1), fem::Load(*flow.space, 1)};
  }
};

using Make = std::unique_ptr<Analogy> (*)(const Settings&, AnalogyMedium);

template <class A>
std::unique_ptr<Analogy> from_medium(const Settings&, AnalogyMedium medium) {
  return std::make_unique<A>(std::move(medium));
}

template <class A>
std::unique_ptr<Analogy> from_both(const Settings& settings, AnalogyMedium medium) {
  return std::make_unique<A>(settings, std::move(medium));
}

const std::vector<std::pair<std::string, Make>>& makers() {
  static const std::vector<std::pair<std::string, Make>> all = {
      {"pressure_rate", from_medium<PressureRate>}, {"pcwe", from_both<ConvectedPressureRate>},
      {"ape", from_both<AcousticPerturbation>},     {"lighthill", from_medium<Lighthill>},
      {"vortex", from_medium<VortexSound>},         {"none", from_medium<NoAnalogy>},
  };
  return all;
}

}  // namespace

std::vector<std::string> analogy_names() {
  std::vector<std::string> names;
  for (const auto& [name, make] : makers()) names.push_back(name);
  return names;
}

std::unique_ptr<Analogy> make_analogy(const Settings& settings, AnalogyMedium medium) {
  for (const auto& [name, make] : makers()) {
    if (name == settings.name) return make(settings, std::move(medium));
  }
  throw base::UserError("acoustic.analogy must be one of " + base::list_of(analogy_names()), settings.name,
                        base::did_you_mean(settings.name, analogy_names()));
}

}  // namespace vocalis::coupling
