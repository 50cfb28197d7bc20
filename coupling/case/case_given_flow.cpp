#include "core/base/error.hpp"
#include "coupling/case/case_sections.hpp"

namespace vocalis::coupling {

namespace {

using base::UserError;

VortexPair read_vortex_pair(base::Table& table, Case& config) {
  VortexPair pair;
  pair.density = config.fluid.density;
  pair.circulation = table.number("circulation", base::any_number, "m^2/s");
  pair.radius = table.number("radius", base::positive, "m");
  pair.core_radius = table.number("core_radius", base::positive, "m");
  pair.centre = read_vector_or(table, "centre", pair.centre, "m", config);
  pair.phase = table.number_or("phase", pair.phase, base::any_number, "rad");
  pair.rotation_rate = table.number_or("rotation_rate", rotation_rate_of_points(pair.circulation, pair.radius),
                                       base::any_number, "rad/s");
  return pair;
}

DuctPiston read_duct(base::Table& table, const Case& config) {
  DuctPiston duct;
  duct.density = config.fluid.density;
  duct.pulse.amplitude = table.number("amplitude", base::positive, "m/s");
  duct.pulse.maximum_frequency =
      table.number_or("maximum_frequency", duct.pulse.maximum_frequency, base::positive, "Hz");
  duct.start = table.number_or("start", duct.start, base::any_number, "m");
  duct.length = table.number("length", base::positive, "m");
  return duct;
}

UniformFlow read_uniform(base::Table& table, Case& config) {
  UniformFlow flow;
  flow.velocity = read_vector(table, "velocity", "m/s", config);
  flow.pressure = table.number_or("pressure", flow.pressure, base::any_number, "Pa");
  return flow;
}

FlowFormula read_formula(base::Table& table, Case& config) {
  const std::string name = table.text("analytic", {"vortex_pair", "duct", "uniform"});
  if (name == "vortex_pair") return read_vortex_pair(table, config);
  if (name == "duct") return read_duct(table, config);
  return read_uniform(table, config);
}

FlowRecord read_record_names(MPI_Comm comm, base::Table& table, const Case& config) {
  FlowRecord record;
  record.file = read_file_name(comm, table, "record", config);
  record.run = table.text_or("run", record.run);
  return record;
}

}  // namespace

bool is_flow_given(base::Table& root) {
  const auto flow = root.table_if("flow");
  return flow && (flow->has("analytic") || flow->has("record"));
}

void read_given_flow(MPI_Comm comm, base::Table& root, Case& config) {
  if (!is_flow_given(root)) return;
  base::Table table = root.table("flow");
  if (table.has("analytic") && table.has("record")) {
    throw UserError(table.place() + " is given by a formula or by a record", "both", "leave out analytic or record");
  }
  const fsi::FlowSettings usual;
  config.fluid.density = table.number_or("density", usual.density, base::positive, "kg/m^3");
  if (table.has("analytic")) {
    config.given_flow = read_formula(table, config);
  } else {
    config.given_flow = read_record_names(comm, table, config);
    config.fluid.viscosity = table.number_or("viscosity", usual.viscosity, base::not_negative, "Pa s");
  }
}

void read_record(base::Table& root, Case& config) {
  auto table = root.table_if("record");
  if (!table) return;
  RecordSettings& record = config.record.emplace();
  record.precision = table->choice_or<Precision>("precision", record.precision,
                                                 {{"double", Precision::double_}, {"single", Precision::single}});
  if (config.flow || (config.given_flow && std::holds_alternative<FlowFormula>(*config.given_flow))) return;
  throw UserError(table->place() + " writes down a flow that is solved or given by a formula",
                  config.given_flow ? "one that is recorded already" : "no [flow]", "leave [record] out");
}

}  // namespace vocalis::coupling
