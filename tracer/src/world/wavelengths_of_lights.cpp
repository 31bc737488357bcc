#include "world/wavelengths_of_lights.hpp"

#include <algorithm>
#include <vector>

namespace phasetree::tracer {

namespace {

// The spectrum of each light of a scene: null for one without.
std::vector<SharedLightSpectrum> spectra_of(const Scene& scene) {
    std::vector<SharedLightSpectrum> spectra(scene.lights.spectra());
    const auto add = [&](const Material& material) {
        if (const Glowing* glowing = emission_of(material))
            spectra.push_back(glowing->spectrum);
        else if (const auto* clear = std::get_if<Clear>(&material); clear && is_emissive(clear->interior))
            spectra.push_back(emission_spectrum(clear->interior));
    };
    for (const Material& material : scene.materials) add(material);
    for (const Mesh& mesh : scene.meshes) add(mesh.material);
    return spectra;
}

}  // namespace

WavelengthDistribution wavelengths_of_lights(const Scene& scene) {
    const std::vector<SharedLightSpectrum> spectra = spectra_of(scene);
    if (std::ranges::none_of(spectra, [](const SharedLightSpectrum& spectrum) { return spectrum != nullptr; }))
        return {};
    // Spectra have the luminance 1, which would give a violet lamp a hundred times the weight of a green one. They are
    // scaled to the mean 1 here. No spectrum is black: such scene files are rejected.
    std::vector<double> scale;
    for (const SharedLightSpectrum& spectrum : spectra)
        scale.push_back(
            spectrum ? 1.0 / mean_of([&](double nm) { return double{spectrum->relative_at(static_cast<float>(nm))}; })
                     : 1.0);
    return WavelengthDistribution([&](double nanometres) {
        double sum = 0.0;
        for (std::size_t i = 0; i < spectra.size(); ++i)
            sum += scale[i] * (spectra[i] ? double{spectra[i]->relative_at(static_cast<float>(nanometres))} : 1.0);
        return 0.5 + 0.5 * sum / static_cast<double>(spectra.size());
    });
}

}  // namespace phasetree::tracer
