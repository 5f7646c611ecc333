/* Prints the vendor of the OpenGL that a program for Windows gets: in a window of its own, as such
 * programs do. */
#include <GL/gl.h>
#include <stdio.h>
#include <windows.h>

int main(void) {
  WNDCLASSA class = {.lpfnWndProc = DefWindowProcA, .lpszClassName = "vendor"};
  RegisterClassA(&class);
  HWND window =
      CreateWindowA("vendor", "", WS_OVERLAPPEDWINDOW, 0, 0, 16, 16, NULL, NULL, NULL, NULL);
  HDC device = GetDC(window);
  PIXELFORMATDESCRIPTOR wanted = {
      .nSize = sizeof wanted, .nVersion = 1, .cColorBits = 24, .cDepthBits = 24};
  wanted.dwFlags = PFD_DRAW_TO_WINDOW | PFD_SUPPORT_OPENGL;
  SetPixelFormat(device, ChoosePixelFormat(device, &wanted), &wanted);
  HGLRC context = wglCreateContext(device);
  if (!context || !wglMakeCurrent(device, context)) return 2;
  printf("%s, %s\n", (char const*)glGetString(GL_VENDOR), (char const*)glGetString(GL_RENDERER));
  return 0;
}
