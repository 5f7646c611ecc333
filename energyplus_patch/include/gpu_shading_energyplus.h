/* GPU shading for a program that runs EnergyPlus through its C or Python API.
 *
 * Load EnergyPlus's library, then libgpu_shading_energyplus.so (RTLD_LOCAL for both), and call
 * gpu_shading_install once before the first run. Every later run of every state in the process is
 * then shaded by this module. C linkage; no exception leaves these functions. */
#ifndef GPU_SHADING_ENERGYPLUS_H
#define GPU_SHADING_ENERGYPLUS_H

#ifdef __cplusplus
extern "C" {
#endif

/* Takes over the shading calculation of the EnergyPlus library loaded from `energyplus_library`, or
 * of the one libenergyplusapi in the process when NULL. `options`: the launcher's flags, one a line
 * or separated by blanks, e.g.
 * "--gpu-shading=require --gpu-shading-resolution=1024"; NULL or empty for none. What they leave
 * open comes from the environment (GPU_SHADING_...), the model, and the built-in defaults, in this
 * order. Returns 0, or 1 with nothing changed and the reason in gpu_shading_message(). Calling it
 * again for the same library replaces the options. Not while a run is in progress. */
int gpu_shading_install(char const* energyplus_library, char const* options);

/* Why the last gpu_shading_install of this thread returned 1; one or more lines. Never NULL. */
char const* gpu_shading_message(void);

#ifdef __cplusplus
}
#endif

#endif
