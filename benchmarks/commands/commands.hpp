// The subcommands of phasetree-bench, one file each.
#pragma once

#include "measure/report.hpp"
#include "settings.hpp"

namespace phasetree::bench {

Report table1(const Settings&);
Report scaling(const Settings&);
Report mesh(const Settings&);
Report triangles(const Settings&);
Report instances(const Settings&);
Report volumes(const Settings&);
Report naive(const Settings&);
Report phases(const Settings&);
Report quality(const Settings&);
Report simd(const Settings&);
Report host(const Settings&);
Report light(const Settings&);
Report lamps(const Settings&);
Report carve(const Settings&);
Report proxies(const Settings&);
Report balls(const Settings&);
Report resolution(const Settings&);
Report march(const Settings&);
Report fingerprint(const Settings&);

}  // namespace phasetree::bench
