!> The four phases under the names that FELAND gave them: BOR (specify), DIM (size), GEST (build), CAL (contribute).
!>
!> ierr is 0 if the phase is done; text is that of the error. An element goes through the phases in their order: a phase that is
!> out of order gives SPLASHDOWN_NULL or SPLASHDOWN_NO_HANDLE.
module legacy_names
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t, c_size_t
  use splashdown
  implicit none
  private
  public :: sph_element, bor, dim_sph, gest, cal

  !> An element of the host, before and after it is built.
  type :: sph_element
    type(splashdown_scene) :: scene
    type(splashdown_element) :: element
  end type

contains

  !> Specify: the scene, with settings "key=value".
  subroutine bor(e, scene, settings, interface_kind, ierr, text)
    type(sph_element), intent(inout) :: e
    character(len=*), intent(in) :: scene, settings(:)
    integer(c_int32_t), intent(in) :: interface_kind
    integer, intent(out) :: ierr
    character(len=:), allocatable, intent(out) :: text
    call splashdown_open(scene, settings, interface_kind, e%scene, ierr, text)
  end subroutine
