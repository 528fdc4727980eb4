!> The four phases under the names that FELAND gave the routines of an element: BOR (specify), DIM (size), GEST (build),
!> CAL (contribute).
!>
!> ierr is 0 if the phase is done, otherwise a value of stat of the module splashdown; text is that of the error. An element goes
!> through the phases in their order: one that is out of order gives SPLASHDOWN_NULL or SPLASHDOWN_NO_HANDLE.
module legacy_names
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use splashdown
  implicit none
  private
  public :: sph_element, bor, dim, gest, cal

  !> An element of the host, before and after it is built.
  type :: sph_element
    type(splashdown_scene) :: scene
    type(splashdown_element) :: water
  end type

contains

  !> The characteristics of the element: a scene, with settings "key=value".
  subroutine bor(e, scene, settings, interface_kind, ierr, text)
    type(sph_element), intent(inout) :: e
    character(len=*), intent(in) :: scene, settings(:)
    integer(c_int32_t), intent(in) :: interface_kind
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: text
    call splashdown_open(scene, settings, interface_kind, e%scene, ierr, text)
  end subroutine

  !> Dimensions: nodes, particles of water and walls, memory [bytes].
  subroutine dim(e, nodes, fluid, walls, bytes, ierr, text)
    type(sph_element), intent(in) :: e
    integer, intent(out) :: nodes, fluid, walls
    integer(c_int64_t), intent(out) :: bytes
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: text
    type(splashdown_scene_sizes) :: sizes
    call splashdown_sizes(e%scene, sizes, ierr, text)
    nodes = 0
    fluid = 0
    walls = 0
    bytes = 0
    if (ierr /= 0) return
    nodes = int(sizes%nodes)
    fluid = int(sizes%fluid_particles)
    walls = int(sizes%wall_particles)
    bytes = sizes%bytes
  end subroutine

  !> The water at the start; nodes are allocated here and filled with their places and velocities.
  subroutine gest(e, nodes, ierr, text)
    type(sph_element), intent(inout) :: e
    type(splashdown_host_nodes), intent(out) :: nodes
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: text
    call splashdown_scene_nodes(e%scene, nodes, ierr, text)
    if (ierr == 0) call splashdown_build(e%scene, nodes, e%water, ierr, text)
  end subroutine

  !> The contribution of a step dt [s] that ends with these nodes: mean forces F_x, F_y [N/m], M [N] of each.
  subroutine cal(e, dt, nodes, forces, ierr, text)
    type(sph_element), intent(in) :: e
    real(c_double), intent(in) :: dt
    type(splashdown_host_nodes), intent(in) :: nodes
    real(c_double), intent(inout), contiguous :: forces(:, :)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: text
    call splashdown_contribute(e%water, dt, nodes, forces, stat=ierr, message=text)
  end subroutine
end module
