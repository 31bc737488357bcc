#include "integrator/photon_gathering.hpp"

#include <glm/geometric.hpp>

#include "caustics/photon_map.hpp"

namespace phasetree::tracer {

void add_light_of_photon(const PathContext& context, const PathState& path, const Photon& photon,
                         const PhotonScattering& scattering, const glm::vec3& position, const LightProposal& proposal,
                         PathRadiance& radiance) {
    const float weight = photon.weight(scattering.by_photons, scattering.pdf, [&] {
        // A small lamp may be visible in the photon's direction from the photon's line, but from nowhere else near the
        // point. The pdf of shadow rays is therefore evaluated at the closest point of that line, where their weight
        // for the same light complements this one.
        const float along = glm::dot(position - photon.position, photon.direction);
        return proposal.pdf_from(context.scene.lights, photon.position + along * photon.direction, photon.direction);
    });
    const Wavelengths* now = path.wavelengths.now();
    glm::vec3 fluence = scattering.power / context.photons.map->expected();  // over N π r²
    if (photon.of_one_wavelength) {
        if (!path.wavelengths.is_dispersed()) fluence *= path.wavelengths.all()->hero_to_all;
    } else if (now && !now->is_spectral) {
        fluence = for_light(fluence, now);
    }
    radiance.add(path.throughput * scattering.f * fluence * weight, now, photon.source, photon.towards_light, true);
}

}  // namespace phasetree::tracer
