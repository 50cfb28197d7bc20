#include "coupling/analogies/analogy.hpp"

#include "core/base/case_table.hpp"
#include "core/base/error.hpp"
#include "coupling/analogies/pressure_rate.hpp"

namespace vocalis::coupling {

namespace {

/// Silence: the acoustic solver runs with its own sources only.
class NoAnalogy : public Analogy {
 public:
  AnalogySource source(const FlowView& flow) const override {
    return {fem::Load(*flow.space, 1), fem::Load(*flow.space, 1)};
  }
};

}  // namespace

std::vector<std::string> analogy_names() { return {"pressure_rate", "none"}; }

std::unique_ptr<Analogy> make_analogy(const std::string& name, double density, double speed_of_sound) {
  if (name == "pressure_rate") return std::make_unique<PressureRate>(density, speed_of_sound);
  if (name == "none") return std::make_unique<NoAnalogy>();
  throw base::UserError("acoustic.analogy must be one of " + base::list_of(analogy_names()), name,
                        base::did_you_mean(name, analogy_names()));
}

}  // namespace vocalis::coupling
