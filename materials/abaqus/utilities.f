C     Abaqus' utility routines that user subroutines call, to be compiled with them; others are named where a library
C     cannot be loaded. Compile with -ffixed-line-length-132 -fdefault-real-8 -fdefault-double-8.

C     Ends the program; strut tells where.
      subroutine xit
      call exit(1)
      end

      subroutine xplb_exit
      call exit(1)
      end

C     A message as it is; the program ends for a lop of -3.
      subroutine stdb_abqerr(lop, string, intv, realv, charv)
      integer lop, intv(*)
      real realv(*)
      character*(*) string, charv(*)
      write (*, '(a)') trim(string)
      if (lop .eq. -3) call exit(1)
      end

      subroutine xplb_abqerr(lop, string, intv, realv, charv)
      integer lop, intv(*)
      real realv(*)
      character*(*) string, charv(*)
      call stdb_abqerr(lop, string, intv, realv, charv)
      end

C     Mean stress and equivalent stress of von Mises.
      subroutine sinv(stress, sinv1, sinv2, ndi, nshr)
      integer ndi, nshr, k
      real stress(ndi + nshr), sinv1, sinv2
      sinv1 = sum(stress(1:ndi))/3
      sinv2 = (3 - ndi)*sinv1**2
      do k = 1, ndi + nshr
        if (k .le. ndi) sinv2 = sinv2 + (stress(k) - sinv1)**2
        if (k .gt. ndi) sinv2 = sinv2 + 2*stress(k)**2
      end do
      sinv2 = sqrt(1.5*sinv2)
      end

C     R s R^T; lstr 1: stress, 2: strain, whose shears are engineering ones.
      subroutine rotsig(s, r, sprime, lstr, ndi, nshr)
      integer lstr, ndi, nshr, k
      real s(ndi + nshr), r(3, 3), sprime(ndi + nshr), t(3, 3)
      integer row(3), column(3)
      data row /1, 1, 2/, column /2, 3, 3/
      t = 0
      do k = 1, ndi
        t(k, k) = s(k)
      end do
      do k = 1, nshr
        t(row(k), column(k)) = s(ndi + k)/lstr
        t(column(k), row(k)) = t(row(k), column(k))
      end do
      t = matmul(matmul(r, t), transpose(r))
      do k = 1, ndi
        sprime(k) = t(k, k)
      end do
      do k = 1, nshr
        sprime(ndi + k) = t(row(k), column(k))*lstr
      end do
      end
