// An empty library by the name that energyplus_api is linked with; in a patched folder, a link of
// that name leads to EnergyPlus's own.
