@echo off
rem patch_energyplus.cmd ENERGYPLUS FOLDER: copies an EnergyPlus into a new folder, in which energyplus.exe
rem can render shading. The first folder is left as it is. (A name with brackets would end a block of commands in
rem brackets, so there is none.)
setlocal
if "%~2"=="" goto usage
if not exist "%~1\energyplusapi.dll" goto not_energyplus
if exist "%~1\energyplus-official.exe" goto patched
if exist "%~2" goto exists
xcopy "%~1" "%~2" /E /I /Q >nul
if errorlevel 1 goto failed
ren "%~2\energyplus.exe" energyplus-official.exe
if errorlevel 1 goto failed
copy "%~dp0energyplus.exe" "%~2" >nul
if errorlevel 1 goto failed
copy "%~dp0opengl32.dll" "%~2" >nul
if errorlevel 1 goto failed
copy "%~dp0gpu_shading.exe" "%~2" >nul
if errorlevel 1 goto failed
echo patch_energyplus: created "%~2"; run "%~2\energyplus.exe" --gpu-shading ...
exit /b 0

:usage
echo usage: patch_energyplus.cmd "C:\EnergyPlus" "C:\EnergyPlus-shading"
exit /b 1

:not_energyplus
echo patch_energyplus: "%~1": is not an EnergyPlus: it has no energyplusapi.dll 1>&2
exit /b 1

:patched
echo patch_energyplus: "%~1": was made by patch_energyplus; give EnergyPlus's own folder 1>&2
exit /b 1

:exists
echo patch_energyplus: "%~2": is there already 1>&2
exit /b 1

:failed
echo patch_energyplus: "%~2": could not be made 1>&2
exit /b 1
