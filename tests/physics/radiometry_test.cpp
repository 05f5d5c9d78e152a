// SPDX-License-Identifier: Apache-2.0
// Absolute radiometry: what each light sends, what reaches a surface and what the camera makes of it, against closed forms.
#include "tests/support/closed_form.h"

namespace nephroid::radiometry_test {

/// A floor seen from straight above, a light above it, and nothing or a sheet of "glass" with n = 1 between them.
/// The floor is the plane y = 0, reflectance 1; the camera is at height 2 and sees 1 m x 1 m of it.
preset::Preset floor_preset()
{
  preset::Preset p = empty_preset(32);
  p.scene.camera.position = {0, 2, 0};
  p.scene.camera.target = {0, 0, 0};
  p.scene.camera.up = {0, 0, -1};
  p.scene.camera.fov_deg = 2 * std::atan(0.5 / 2) * 180 / M_PI;
  p.scene.materials["white"] = white();
  p.scene.materials["nothing"] = glass(1);
  p.scene.objects.push_back(object("floor", quad(10, 10), "white"));
  preset::Light light;
  light.spectrum.illuminant = "E";
  light.position = {0.1, 1, -0.2};
  light.power_w = 5;
  p.scene.lights.push_back(light);
  return p;
}

/// A sheet that the light crosses before the floor, but that does not hide the floor from the camera: far to the side of its view.
void add_sheet(preset::Preset& p, double height)
{
  p.scene.objects.push_back(object("sheet", box(8, 0.01, 8), "nothing", at({0, height, 0})));
}

/// The colour of radiance E / pi at floor point (x, z), for the light's spectrum of unit sum.
double irradiance_of_point(const preset::Light& light, double intensity, double x, double z)
{
  const double dx = light.position[0] - x, dy = light.position[1], dz = light.position[2] - z;
  const double d2 = dx * dx + dy * dy + dz * dz;
  return intensity * dy / std::sqrt(d2) / d2;
}

/// Mean over the pixels of the ratio picture / truth for the luminance, and the root mean square of the ratio's deviation.
struct Ratio {
  double mean = 0, rms = 0;
};
template <class Truth>
Ratio compare(const job::Snapshot& snapshot, const std::string& name, const Truth& irradiance)
{
  const int size = snapshot.picture->width;
  const double y_of_light = optics::to_xyz(optics::illuminant("E"))[1];
  const job::Layer& picture = layer(snapshot, name);
  Ratio ratio;
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const double y = check::luminance(picture, size, row, column);
      // The mean over a pixel of a smooth function is its value at the centre up to second order, below 1e-4 here.
      const double x = (column + 0.5) / size - 0.5, z = (row + 0.5) / size - 0.5;
      const double r = y / (irradiance(x, z) / M_PI * y_of_light);
      ratio.mean += r / (size * size);
      ratio.rms += (r - 1) * (r - 1) / (size * size);
    }
  ratio.rms = std::sqrt(ratio.rms);
  return ratio;
}

TEST(Radiometry, DirectLightOfAPoint)
{
  preset::Preset p = floor_preset();
  spectral::settings(p).direct = true;
  p.stop.passes = 64;
  const double intensity = p.scene.lights[0].power_w / (4 * M_PI);
  const Ratio r = compare(render(p), "direct", [&](double x, double z) { return irradiance_of_point(p.scene.lights[0], intensity, x, z); });
  expect_truth("radiometry: direct light of a point over its closed form", r.mean, 1, 1e-3);
  EXPECT_LT(r.rms, 0.01);
}

TEST(Radiometry, DirectLightOfASpotInsideItsCone)
{
  preset::Preset p = floor_preset();
  spectral::settings(p).direct = true;
  p.stop.passes = 64;
  preset::Light& light = p.scene.lights[0];
  light.type = preset::Light::Type::spot;
  light.half_angle_deg = 80;
  const double intensity = light.power_w / (2 * M_PI * (1 - std::cos(80 * M_PI / 180)));
  const Ratio r = compare(render(p), "direct", [&](double x, double z) { return irradiance_of_point(light, intensity, x, z); });
  expect_truth("radiometry: direct light of a spot over its closed form", r.mean, 1, 1e-3);
}

TEST(Radiometry, DirectLightOfADirectionalLight)
{
  preset::Preset p = floor_preset();
  spectral::settings(p).direct = true;
  p.stop.passes = 4;
  preset::Light& light = p.scene.lights[0];
  light.type = preset::Light::Type::directional;
  light.direction = {1, -1, 0};
  light.irradiance_w_m2 = 3;
  const Ratio r = compare(render(p), "direct", [&](double, double) { return 3 / std::sqrt(2.0); });
  expect_truth("radiometry: direct light of a directional light over its closed form", r.mean, 1, 1e-5);
  EXPECT_LT(r.rms, 1e-5);
}

/// The irradiance of a small area light is that of a point of intensity power cos / pi.
TEST(Radiometry, DirectLightOfASmallAreaLight)
{
  preset::Preset p = floor_preset();
  spectral::settings(p).direct = true;
  p.stop.passes = 64;
  preset::Light& light = p.scene.lights[0];
  light.type = preset::Light::Type::area;
  light.size = {0.02, 0.02};
  const Ratio r = compare(render(p), "direct", [&](double x, double z) {
    const double d = std::hypot(light.position[0] - x, light.position[1], light.position[2] - z);
    return irradiance_of_point(light, light.power_w / M_PI * light.position[1] / d, x, z);
  });
  expect_truth("radiometry: direct light of a small area light over its closed form", r.mean, 1, 2e-3);
}

// A dielectric of n = 1 bends nothing and reflects nothing, so the photons that crossed it must make the very picture that
// direct light makes. The sheet lies between light and floor and, for the camera, above it: the splat's way to the eye is
// blocked by it, so the camera looks from below the sheet.
class Photons : public testing::TestWithParam<preset::Light::Type> {};

TEST_P(Photons, ThroughNothingMakeTheDirectPicture)
{
  preset::Preset p = floor_preset();
  add_sheet(p, 0.9);
  p.scene.camera.position = {0, 0.5, 0};
  p.scene.camera.fov_deg = 90;
  preset::Light& light = p.scene.lights[0];
  light.type = GetParam();
  light.half_angle_deg = 75;
  light.direction = {0.3, -1, 0.2};
  light.irradiance_w_m2 = 7;
  light.size = {0.01, 0.01};
  light.up = {0, 0, 1};
  p.stop.passes = 16;
  spectral::settings(p).photons_per_pass = 1 << 18;
  const double cone = 2 * M_PI * (1 - std::cos(75 * M_PI / 180));
  const double length = std::hypot(0.3, 1, 0.2);
  const auto truth = [&](double x, double z) {
    const double d = std::hypot(light.position[0] - x, light.position[1], light.position[2] - z);
    const double cos_light = -((x - light.position[0]) * -0.3 + light.position[1] * -1.0 + (z - light.position[2]) * -0.2) / (d * length);
    switch (GetParam()) {
    case preset::Light::Type::point:
      return irradiance_of_point(light, light.power_w / (4 * M_PI), x, z);
    case preset::Light::Type::spot:
      return irradiance_of_point(light, light.power_w / cone, x, z);
    case preset::Light::Type::directional:
      return 7 / length;
    case preset::Light::Type::area:
      break;
    }
    return irradiance_of_point(light, light.power_w / M_PI * cos_light, x, z);
  };
  const job::Snapshot snapshot = render(p);
  const Ratio r = compare(snapshot, "caustic", truth);
  // The fewest photons land under directional light: 2^22 on the 100 m^2 of the sheet's bounding disc, so 41 a pixel, which is
  // 16 % noise, and 0.5 % for the mean over all pixels; the rms over 1024 pixels is then known to 0.4 %. Six standard deviations of each.
  expect_truth("radiometry: power through n = 1 over direct light", r.mean, 1, 0.031);
  EXPECT_LT(r.rms, 0.185);
  EXPECT_EQ(spectral::energy_of(snapshot).refused_contributions, 0u);
}

std::string light_name(const testing::TestParamInfo<preset::Light::Type>& parameter)
{
  static const char* const names[] = {"point", "spot", "directional", "area"};
  return names[static_cast<int>(parameter.param)];
}

INSTANTIATE_TEST_SUITE_P(Lights, Photons,
                         testing::Values(preset::Light::Type::point, preset::Light::Type::spot, preset::Light::Type::directional,
                                         preset::Light::Type::area),
                         light_name);

} // namespace nephroid::radiometry_test
