/* GPU shading for a program that runs EnergyPlus through its C or Python API.
 *
 * Load EnergyPlus's library, then libgpu_shading_energyplus.so (RTLD_LOCAL for both), and call
 * gpu_shading_install once before the first run. Every later run of every state in the process is
 * then shaded by this module. With the libenergyplusapi.so of a folder made by patch_energyplus, no
 * call is needed where GPU_SHADING is set. C linkage; no exception leaves these functions. */
#ifndef GPU_SHADING_ENERGYPLUS_H
#define GPU_SHADING_ENERGYPLUS_H

#ifdef __cplusplus
extern "C" {
#endif

/* What these functions return instead of an exit status; gpu_shading_message() has the reason. */
enum gpu_shading_status {
  gpu_shading_done = 0,
  gpu_shading_failed = -1,
  gpu_shading_cannot_patch = -2 /* this library, or this model, does not allow the method */
};

/* Takes over the shading calculation of the EnergyPlus library loaded from `energyplus_library`, or
 * of the one libenergyplusapi in the process when NULL. `options`: `count` flags of the launcher,
 * e.g.
 * "--gpu-shading=require" and "--gpu-shading-resolution=1024"; may be NULL if count is 0. What they
 * leave open comes from the environment (GPU_SHADING_...), the model, and the built-in defaults, in
 * this order. Returns a gpu_shading_status; if it fails, nothing is changed. Calling it again for
 * the same library replaces the options. Not while a run is in progress. */
int gpu_shading_install(char const* energyplus_library, int count, char const* const* options);

/* For the libenergyplusapi.so of a folder made by patch_energyplus: the same without options, and
 * without any change where a host has called gpu_shading_install. */
int gpu_shading_install_from_environment(char const* energyplus_library);

/* Why the last of these functions failed in this thread; one or more lines. Never NULL. */
char const* gpu_shading_message(void);

/* Why not all that GPU shading was to write of this thread's last run is there, such as a report on
 * a full disk: one line, empty where all is. EnergyPlus's own results are not concerned. Never
 * NULL. */
char const* gpu_shading_unwritten(void);

/* A whole run of an EnergyPlus library whose shading functions cannot be patched, which need not be
 * loaded: it counts pixels, and its calls of OpenGL are answered. Arguments as below. Returns
 * EnergyPlus's exit status, or a negative gpu_shading_status. One such run per process. */
int gpu_shading_run_opengl(char const* energyplus_library, int count, char const* const* options,
                           int argc, char const* const* argv);

/* A whole run of an EnergyPlus library that cannot be patched, which need not be loaded: sunlit
 * fractions are rendered first and go in as schedules. `options` as above; `argv`: EnergyPlus's own
 * arguments without the program. The folder of this process's program has to hold one by the name
 * of energyplus that runs the library as it is, as in a folder made by patch_energyplus. Returns
 * EnergyPlus's exit status, or gpu_shading_failed. */
int gpu_shading_run_scheduled(char const* energyplus_library, int count, char const* const* options,
                              int argc, char const* const* argv);

/* For a host that refuses a run before EnergyPlus starts, for example since gpu_shading_install has
 * failed: writes eplusout.err and eplusout.end with the reason `why`, as an EnergyPlus does that
 * stops on its input, where `argv`, EnergyPlus's own arguments without the program, ask for them.
 * `energyplus_library` is beside its Energy+.idd. */
void gpu_shading_report_refusal(char const* energyplus_library, char const* why, int argc,
                                char const* const* argv);

#ifdef __cplusplus
}
#endif

#endif
