#include "tools/options/light_options.h"

#include "tools/cli/cli.h"

namespace farcell {

void addLightOptions(CLI::App& app, LightOptions& options) {
  app.add_option("--light", options.light,
                 "sun, or headlight: along the view axis; other light than the pack's own sun needs a relightable pack")
      ->check(CLI::IsMember({"sun", "headlight"}))
      ->capture_default_str();
  app.add_option("--sun", options.sun,
                 "where the sun stands, degrees: around the up axis (z up: from x towards y) and above the horizon; "
                 "default: the pack's own")
      ->type_name("AZIMUTH,ELEVATION");
}

Result<Light> lightOf(const LightOptions& options) {
  Light light;
  if (options.light == "headlight") light.kind = LightKind::headlight;
  if (options.sun.empty()) return light;
  if (light.kind == LightKind::headlight)
    return fail(ErrorKind::invalidArgument, "--sun says where the sun stands, but --light is headlight");
  FARCELL_ASSIGN(light.sun, parseSun("--sun", options.sun));
  return light;
}

}  // namespace farcell
